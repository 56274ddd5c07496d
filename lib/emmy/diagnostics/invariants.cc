#include "emmy/diagnostics/invariants.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "emmy/base/check.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/model/state_size.h"

namespace emmy {
namespace {

const DoubleDouble kHalf(0.5);

// ANCF bodies and nodes: everything linear has one constant mass matrix.
void AddLinear(const Model& model, const State& state, Invariants* invariants) {
  const DoubleDouble3 gravity = DoubleDouble3::FromDouble(model.gravity());
  const auto position = [&](size_t v) {
    return Extended3(state.position, model.vectors()[v].position_offset);
  };
  const auto velocity = [&](size_t v) {
    return Extended3(state.velocity, model.vectors()[v].velocity_offset);
  };
  for (size_t v = 0; v < model.vectors().size(); ++v) {
    DoubleDouble3 momentum;  // Row v of M w.
    for (const MassEntry& entry : model.mass()[v]) {
      momentum += DoubleDouble(entry.mass) *
                  velocity(static_cast<size_t>(entry.column));
    }
    invariants->kinetic_energy += kHalf * Dot(velocity(v), momentum);
    invariants->angular_momentum += Cross(position(v), momentum);
    const double first_moment = model.vectors()[v].first_moment;
    if (first_moment != 0.0) {
      invariants->momentum += DoubleDouble(first_moment) * velocity(v);
      invariants->gravity_energy -=
          DoubleDouble(first_moment) * Dot(gravity, position(v));
    }
  }
  for (const GroundMass& ground : model.ground_mass()) {
    invariants->angular_momentum +=
        Cross(DoubleDouble3::FromDouble(ground.position),
              DoubleDouble(ground.mass) *
                  velocity(static_cast<size_t>(ground.vector)));
  }
}

void AddElasticEnergies(const Model& model, const State& state,
                        Invariants* invariants) {
  for (const ModelBody& body : model.bodies()) {
    if (body.ancf() == nullptr) continue;
    const Vector6d& stiffness = body.ancf()->penalty_stiffness();
    for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
      const DoubleDouble strain =
          Extended(state.strain, body.strain_offset + k);
      invariants->penalty_energy +=
          DoubleDouble(0.5 * stiffness(k)) * (strain * strain);
    }
  }
  for (const ModelLine& line : model.lines()) {
    invariants->elastic_energy +=
        line.element.Energy(Extended(state.strain, line.strain_offset));
  }
}

void AddConventional(const Model& model, const ModelBody& body,
                     const State& state, Invariants* invariants) {
  const DoubleDouble mass(body.inertia().mass);
  const DoubleDouble3 position =
      Extended3(state.position, body.position_offset);
  const DoubleDouble3 velocity =
      Extended3(state.velocity, body.velocity_offset);
  const DoubleDouble3 linear_momentum = mass * velocity;
  invariants->kinetic_energy += kHalf * Dot(velocity, linear_momentum);
  invariants->gravity_energy -=
      mass * Dot(DoubleDouble3::FromDouble(model.gravity()), position);
  invariants->momentum += linear_momentum;
  invariants->angular_momentum += Cross(position, linear_momentum);
  const Matrix3d& tensor = body.conventional()->tensor();
  const DoubleDouble3 omega =
      Extended3(state.velocity, body.velocity_offset + 3);
  DoubleDouble3 momentum;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (tensor(i, j) != 0.0) {
        momentum[i] += DoubleDouble(tensor(i, j)) * omega[j];
      }
    }
  }
  invariants->kinetic_energy += kHalf * Dot(omega, momentum);
  const std::array<DoubleDouble3, 3> frame = ExtendedFrame(body, state);
  for (int j = 0; j < 3; ++j) {
    invariants->angular_momentum += momentum[j] * frame[static_cast<size_t>(j)];
  }
}

// What a line's consistent mass m/6 [2 1; 1 2] adds where an end is on a
// conventional body. The part of a linear end alone is in AddLinear.
void AddConventionalEnds(const Model& model, const State& state,
                         const ModelLine& line, Invariants* invariants) {
  std::array<DoubleDouble3, 2> position;
  std::array<DoubleDouble3, 2> velocity;
  for (size_t i = 0; i < 2; ++i) {
    position[i] = ExtendedPosition(model, state, line.ends[i]);
    if (line.end_velocity_offset[i] >= 0) {
      velocity[i] = Extended3(state.end_velocity, line.end_velocity_offset[i]);
      continue;
    }
    for (const WeightedVector& term : line.ends[i].terms) {
      const VectorCoordinate& v =
          model.vectors()[static_cast<size_t>(term.vector)];
      velocity[i] += DoubleDouble(term.weight) *
                     Extended3(state.velocity, v.velocity_offset);
    }
  }
  const DoubleDouble third(line.mass / 3.0);
  const DoubleDouble sixth(line.mass / 6.0);
  const DoubleDouble half(0.5 * line.mass);
  const DoubleDouble3 gravity = DoubleDouble3::FromDouble(model.gravity());
  for (size_t i = 0; i < 2; ++i) {
    const DoubleDouble3 shared = sixth * velocity[1 - i];
    invariants->kinetic_energy += kHalf * Dot(velocity[i], shared);
    invariants->angular_momentum += Cross(position[i], shared);
    if (line.end_velocity_offset[i] < 0) continue;
    const DoubleDouble3 own = third * velocity[i];
    invariants->kinetic_energy += kHalf * Dot(velocity[i], own);
    invariants->angular_momentum += Cross(position[i], own);
    invariants->momentum += half * velocity[i];
    invariants->gravity_energy -= half * Dot(gravity, position[i]);
  }
}

}  // namespace

Invariants MeasureInvariants(const Model& model, const State& state) {
  EMMY_CHECK(SizeOf(state) == SizeOf(model), "a state of " << SizeOf(state)
                                                           << " for a model of "
                                                           << SizeOf(model));
  Invariants invariants;
  AddLinear(model, state, &invariants);
  AddElasticEnergies(model, state, &invariants);
  for (const ModelBody& body : model.bodies()) {
    if (body.conventional() != nullptr) {
      AddConventional(model, body, state, &invariants);
    }
  }
  for (const ModelLine& line : model.lines()) {
    if (line.has_conventional_end() && line.mass > 0.0) {
      AddConventionalEnds(model, state, line, &invariants);
    }
  }
  invariants.load_work = {state.load_work.value, state.load_work.compensation};
  return invariants;
}

bool IsFinite(const Invariants& invariants) {
  return std::isfinite(invariants.TotalEnergy().ToDouble()) &&
         std::isfinite(invariants.InternalEnergy().ToDouble()) &&
         std::isfinite(invariants.momentum.ToDouble().stableNorm()) &&
         std::isfinite(invariants.angular_momentum.ToDouble().stableNorm());
}

double StrainGap(const Model& model, const State& state) {
  double gap = 0.0;
  for (const ModelLine& line : model.lines()) {
    const DoubleDouble3 d = ExtendedPosition(model, state, line.ends[1]) -
                            ExtendedPosition(model, state, line.ends[0]);
    const DoubleDouble carried = Extended(state.strain, line.strain_offset);
    gap = std::max(gap, std::abs((line.element.Value(d) - carried).ToDouble()));
  }
  for (const ModelBody& body : model.bodies()) {
    if (body.ancf() == nullptr) continue;
    const auto gradient = [&](int i) {
      return Extended3(state.position, body.position_offset + 3 + 3 * i);
    };
    for (int k = 0; k < 3; ++k) {
      const DoubleDouble normal =
          kHalf * (Dot(gradient(k), gradient(k)) - DoubleDouble(1.0));
      const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(k)];
      const DoubleDouble shear = Dot(gradient(m), gradient(n));
      const Eigen::Index s = body.strain_offset + k;
      gap = std::max(
          {gap, std::abs((normal - Extended(state.strain, s)).ToDouble()),
           std::abs((shear - Extended(state.strain, s + 3)).ToDouble())});
    }
  }
  return gap;
}

}  // namespace emmy
