// The laws one by one: force from energy, the continuous equations along the
// exact motion, and what a step that is not solved does to the energy.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/element/line_element.h"
#include "emmy/element/relaxed_start.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/claims/groups.h"
#include "verification/claims/long_double.h"
#include "verification/exact/free_rigid_body.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

using Complex = std::complex<long double>;

constexpr int kTrials = 200;
// A derivative by an imaginary step has no cancellation, however small.
constexpr Real kImaginary = 1e-30L;

// (ANCF-5) of any number type, written again from the coordinates.
template <typename T>
T PenaltyEnergy(const Vector6d& stiffness, const Eigen::Matrix<T, 3, 3>& e) {
  const auto dot = [&e](int i, int j) {
    return e(0, i) * e(0, j) + e(1, i) * e(1, j) + e(2, i) * e(2, j);
  };
  T energy(0.0L);
  for (int i = 0; i < 3; ++i) {
    const T normal = T(0.5L) * (dot(i, i) - T(1.0L));
    const T shear = dot(i, (i + 1) % 3);
    energy += T(0.5L * Wide(stiffness(i))) * normal * normal +
              T(0.5L * Wide(stiffness(3 + i))) * shear * shear;
  }
  return energy;
}

// Largest error of a component / (u · the sizes of the terms it is made of).
double BodyForceError(const AncfRigidBody& body, const Matrix3d& e,
                      double wrong) {
  const Matrix3d force = body.InternalForce(e, AncfRigidBody::Strain(e));
  const double size =
      body.penalty_stiffness().maxCoeff() * e.squaredNorm() * e.norm();
  double error = 0.0;
  for (int k = 0; k < 9; ++k) {
    Eigen::Matrix<Complex, 3, 3> moved = e.cast<Complex>();
    moved(k) += Complex(0.0L, kImaginary);
    const Real gradient =
        PenaltyEnergy<Complex>(body.penalty_stiffness(), moved).imag() /
        kImaginary;
    error = Larger(error, static_cast<double>(
                              std::abs(Wide(wrong * force(k)) - gradient)) /
                              (kUnitRoundoff * size));
  }
  return error;
}

double LineForceError(const LineElement& line, const Vector3d& d,
                      double wrong) {
  const double value = line.Value(DoubleDouble3::FromDouble(d)).ToDouble();
  const Vector3d force = line.Respond(value, 0.0, 0.0).tension_factor * d;
  const Real length = Wide(line.natural_length());
  const Real stiffness = Wide(line.stiffness());
  double error = 0.0;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<Complex, 3, 1> moved = d.cast<Complex>();
    moved(k) += Complex(0.0L, kImaginary);
    const Complex square =
        moved(0) * moved(0) + moved(1) * moved(1) + moved(2) * moved(2);
    Complex energy;
    Real size = 0.0L;  // Of the force, from its terms.
    if (line.kind() == LineElement::Kind::kSpring) {
      const Complex extension = std::sqrt(square) - length;
      energy = 0.5L * stiffness * extension * extension;
      size = stiffness * (Wide(d.norm()) + length);
    } else {
      const Complex strain =
          (square - length * length) / (2.0L * length * length);
      energy = 0.5L * stiffness * length * strain * strain;
      size = stiffness / length * Wide(d.norm()) *
             (Wide(d.squaredNorm()) + length * length) / (length * length);
    }
    error =
        Larger(error, static_cast<double>(std::abs(Wide(wrong * force(k)) -
                                                   energy.imag() / kImaginary) /
                                          (Wide(kUnitRoundoff) * size)));
  }
  return error;
}

absl::StatusOr<ClaimResult> ForceGradient(const ClaimSetting& setting) {
  const absl::StatusOr<BuiltModel> built = BuildModel(PaperBoxAncf(1e10));
  if (!built.ok()) return built.status();
  const AncfRigidBody& body = *built->model.bodies()[0].ancf();
  const LineElement truss = LineElement::Truss(0.8, 7e6);
  const LineElement spring = LineElement::Spring(0.8, 2e4);
  SampleSource random(20261122);
  const double wrong = 1.0 + setting.fault;
  double body_error = 0.0;
  double truss_error = 0.0;
  double spring_error = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d e = CayleyRotation(random.Entries<Vector3d>(3.0)) *
                       (Matrix3d::Identity() + random.Entries<Matrix3d>(0.2));
    body_error = Larger(body_error, BodyForceError(body, e, wrong));
    const Vector3d d = random.Entries<Vector3d>(1.0);
    truss_error = Larger(truss_error, LineForceError(truss, d, wrong));
    spring_error = Larger(spring_error, LineForceError(spring, d, wrong));
  }
  return ClaimResult{.values = {{"penalty", body_error},
                                {"truss", truss_error},
                                {"spring", spring_error}},
                     .figures = {},
                     .notes = {}};
}

// The acceleration of the exact motion, by differences in binary128 and not by
// Euler's equation, put into M ë + f = 0: the stress S that f needs, in body
// axes, is symmetric where the moment of the inertia forces vanishes.
absl::StatusOr<ClaimResult> ExactMotionResidual(const ClaimSetting& setting) {
  using exact::Quad;
  const absl::StatusOr<BuiltModel> built = BuildModel(PaperBoxAncf(1e10));
  if (!built.ok()) return built.status();
  const AncfRigidBody& body = *built->model.bodies()[0].ancf();
  exact::FreeRigidBodyStart<Quad> start;
  start.inertia = built->model.bodies()[0].inertia().tensor.cast<Quad>();
  start.angular_velocity =
      PaperBoxAncf(1e10).rigid_bodies[0].angular_velocity.cast<Quad>();
  const absl::StatusOr<exact::FreeRigidBody<Quad>> motion =
      exact::FreeRigidBody<Quad>::Create(start);
  if (!motion.ok()) return motion.status();
  double moment = 0.0;
  double stress = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Quad time = Quad(i) / 2;
    const Quad step = Quad(1) / 10000;
    const auto at = [&](int k) -> exact::Matrix3<Quad> {
      return motion->At(time + k * step).attitude;
    };
    const exact::Matrix3<Quad> attitude = at(0);
    const exact::Matrix3<Quad> acceleration =
        (Quad(16) * (at(1) + at(-1)) - (at(2) + at(-2)) - Quad(30) * attitude) /
        (Quad(12) * step * step);
    // S = -Rᵀ ë M
    const Matrix3d needed =
        (-(attitude.transpose() * acceleration *
           body.second_moment().cast<Quad>()))
            .unaryExpr([](const Quad& x) { return static_cast<double>(x); });
    const Vector3d omega = motion->At(time).body_angular_velocity.unaryExpr(
        [](const Quad& x) { return static_cast<double>(x); });
    const Vector6d strain = (1.0 + setting.fault) * RelaxedStrain(body, omega);
    const double size = needed.cwiseAbs().maxCoeff() * kUnitRoundoff;
    for (int k = 0; k < 3; ++k) {
      const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(k)];
      moment = Larger(moment, std::abs(needed(m, n) - needed(n, m)) / size);
      const Vector6d& b = body.penalty_stiffness();
      stress = Larger(
          stress, Larger(std::abs(b(k) * strain(k) - needed(k, k)),
                         std::abs(b(3 + k) * strain(3 + k) - needed(m, n))) /
                      size);
    }
  }
  return ClaimResult{.values = {{"asymmetry of the stress", moment},
                                {"stress of the relaxed strain", stress}},
                     .figures = {},
                     .notes = {}};
}

RealVector Column(const CompensatedVector& v, int vector) {
  RealVector x;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Index k = 3 * vector + i;
    x(i) = Wide(v.value(k)) + Wide(v.compensation(k));
  }
  return x;
}

struct WorkErrors {
  double energy = 0.0;  // / (u · the energies and works summed)
  double moment = 0.0;
  double residual_work = 0.0;  // Relative to the energy, to see it is large.
};

// The residual of (EM-2) from two states, and what (EM-7) says of it.
WorkErrors CheckStep(const Run& run, const State& before, double time_step) {
  const State& after = run.state();
  const ModelBody& model = run.model().bodies()[0];
  const AncfRigidBody& body = *model.ancf();
  const Real h = Wide(time_step);
  RealMatrix mean;
  RealMatrix rate;
  RealMatrix rate_change;
  for (int i = 0; i < 3; ++i) {
    const RealVector w0 = Column(before.velocity, i + 1);
    const RealVector w1 = Column(after.velocity, i + 1);
    rate.col(i) = 0.5L * (w0 + w1);
    rate_change.col(i) = w1 - w0;
    mean.col(i) =
        0.5L * (Column(before.position, i + 1) + Column(after.position, i + 1));
  }
  RealMatrix residual = rate_change * body.second_moment().cast<Real>();
  Real size = 0.0L;  // Of the works that cancel.
  for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
    const Real strain =
        0.5L *
        (Wide(before.strain.value(k)) + Wide(before.strain.compensation(k)) +
         Wide(after.strain.value(k)) + Wide(after.strain.compensation(k)));
    const Real stress = h * Wide(body.penalty_stiffness()(k)) * strain;
    if (k < 3) {
      residual.col(k) += stress * mean.col(k);
      size += std::abs(stress) * rate.col(k).norm() * mean.col(k).norm();
    } else {
      const auto [m, n] =
          AncfRigidBody::kShearPairs[static_cast<size_t>(k - 3)];
      residual.col(m) += stress * mean.col(n);
      residual.col(n) += stress * mean.col(m);
      size += std::abs(stress) * (rate.col(m).norm() * mean.col(n).norm() +
                                  rate.col(n).norm() * mean.col(m).norm());
    }
  }
  Real work = 0.0L;
  RealVector moment = RealVector::Zero();
  for (int i = 0; i < 3; ++i) {
    work += rate.col(i).dot(residual.col(i));
    moment += mean.col(i).cross(residual.col(i));
  }
  const Invariants first = MeasureInvariants(run.model(), before);
  const Invariants second = MeasureInvariants(run.model(), after);
  const DoubleDouble change = second.TotalEnergy() - first.TotalEnergy();
  const DoubleDouble3 turn = second.angular_momentum - first.angular_momentum;
  const Real energy = Wide(Larger(first.InternalEnergy().ToDouble(),
                                  second.InternalEnergy().ToDouble()));
  WorkErrors errors;
  errors.energy =
      static_cast<double>(std::abs(Wide(change.hi) + Wide(change.lo) - work) /
                          (Wide(kUnitRoundoff) * (energy + size)));
  RealVector momentum_change;
  for (int i = 0; i < 3; ++i) {
    momentum_change(i) = Wide(turn[i].hi) + Wide(turn[i].lo);
  }
  errors.moment = static_cast<double>(
      (momentum_change - moment).norm() /
      (Wide(kUnitRoundoff) *
       (Wide(first.angular_momentum.ToDouble().norm()) + size)));
  errors.residual_work = static_cast<double>(std::abs(work) / energy);
  return errors;
}

// Steps of any size, 1e-4 to 0.3 s, iterated as little as is accepted.
absl::StatusOr<ClaimResult> ResidualWork(const ClaimSetting& setting) {
  ClaimResult result;
  SampleSource random(20261123);
  for (const double penalty : {1e4, 1e6, 1e8}) {
    double energy = 0.0;
    double moment = 0.0;
    double largest = 0.0;
    int checked = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const double time_step = std::pow(10.0, -2.25 + 1.75 * random.Next());
      absl::StatusOr<Run> run =
          Run::Start(PaperBoxAncf(penalty),
                     {.time_step = time_step,
                      .tolerance = std::pow(10.0, -4.0 + 2.0 * random.Next())},
                     setting.scheme);
      if (!run.ok()) return run.status();
      for (int i = 0; i < 5; ++i) {
        const State before = run->state();
        if (!run->Step().ok()) break;
        ++checked;
        const WorkErrors errors = CheckStep(*run, before, time_step);
        energy = Larger(energy, errors.energy);
        moment = Larger(moment, errors.moment);
        largest = Larger(largest, errors.residual_work);
      }
    }
    // Nothing is claimed of steps that report a failure, but some must not.
    if (checked < kTrials) energy = std::nan("");
    result.values.push_back(
        {absl::StrCat(PenaltyLabel(penalty), ", energy"), energy});
    result.values.push_back(
        {absl::StrCat(PenaltyLabel(penalty), ", angular momentum"), moment});
    result.notes.push_back(absl::StrFormat(
        "%s: %d steps, their residuals did work up to %.2g of the energy",
        PenaltyLabel(penalty), checked, largest));
  }
  return result;
}

// Two boxes that share a point, and what the joint's force does.
absl::StatusOr<ClaimResult> JointWork(const ClaimSetting& setting) {
  ModelDescription description = PaperBoxAncf(1e8);
  RigidBodyDescription other = description.rigid_bodies[0];
  other.name = "other";
  other.angular_velocity = Vector3d(-0.2, 0.4, 0.6);
  const Vector3d arm(1.5, 0.0, 0.0);
  other.position = 2.0 * arm;
  other.velocity = description.rigid_bodies[0].angular_velocity.cross(arm) +
                   other.angular_velocity.cross(arm);
  description.shared_points.push_back(
      {BodyPoint{description.rigid_bodies[0].name, arm},
       BodyPoint{"other", -arm}});
  description.rigid_bodies.push_back(other);
  constexpr double kStep = 1e-2;
  absl::StatusOr<Run> run = Run::Start(description, kStep, setting.scheme);
  if (!run.ok()) return run.status();
  double work = 0.0;
  double drift = 0.0;
  double largest_force = 0.0;
  const auto gap = [&run](const State& state) {
    DoubleDouble3 sum;
    for (const WeightedVector& term : run->model().constraints()[0].terms) {
      const VectorCoordinate& v =
          run->model().vectors()[static_cast<size_t>(term.vector)];
      sum += DoubleDouble(term.weight) *
             Extended3(state.position, v.position_offset);
    }
    return sum;
  };
  const DoubleDouble3 start = gap(run->state());
  for (int i = 0; i < 2000; ++i) {
    const State before = run->state();
    const absl::Status status = run->Advance(1);
    if (!status.ok()) return status;
    const Vector3d opening = (gap(run->state()) - gap(before)).ToDouble();
    const Vector3d force = run->state().multiplier.differences.col(0).head<3>();
    const double size = kUnitRoundoff * force.norm() * kStep *
                        run->state().velocity.value.cwiseAbs().maxCoeff();
    work = Larger(work, std::abs(force.dot(opening)) / size);
    drift = Larger(drift,
                   Norm(gap(run->state()) - start).ToDouble() / kUnitRoundoff);
    largest_force = Larger(largest_force, force.norm());
  }
  return ClaimResult{.values = {{"work of a step / (u |force| dt |w|)", work},
                                {"drift / (u 1 m)", drift}},
                     .figures = {},
                     .notes = {absl::StrFormat(
                         "forces in the joint up to %.3g N", largest_force)}};
}

}  // namespace

std::vector<Claim> LawClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "laws/force_gradient",
       .sentence = "The forces of the penalty, of trusses and of springs are "
                   "the gradients of their energies.",
       .equations = "(ANCF-4..6), (LINE-1..5); paper (5), (6), (18), (19)",
       .reference = Reference::kExact,
       .metric = "error of a component / (u sizes of its terms); the energy "
                 "differentiated by an imaginary step",
       .unit = "u",
       .bound = {.upper = 10.0,
                 .derivation = "strain, its product with b and with the "
                               "vectors, their sum: some ten roundings"},
       .measure = ForceGradient});
  claims.push_back(
      {.id = "laws/exact_motion",
       .sentence = "The exact rigid motion satisfies the equations of the ANCF "
                   "body with a symmetric stress, which is that of the relaxed "
                   "strain: inertia forces have no moment.",
       .equations = "(ANCF-6), (ANCF-8), (TOP-3), (TOP-6..9); paper (15)-(17)",
       .reference = Reference::kExact,
       .metric = "error / (u largest stress), at twenty times in 10 s",
       .unit = "u",
       .bound = {.upper = 24.0,
                 .derivation =
                     "the acceleration is good to h^4 / 90 = 1e-18; the second "
                     "moments are rounded (4 u), the relaxed strain takes some "
                     "twenty roundings"},
       .measure = ExactMotionResidual});
  claims.push_back(
      {.id = "laws/residual_work",
       .sentence = "Whatever the step and however badly it is solved, energy "
                   "changes by the work of the residual, and angular momentum "
                   "by its moment.",
       .equations = "(QS-1), (QS-2), (EM-1..3), (EM-7); paper (22)-(29)",
       .reference = Reference::kExact,
       .metric = "error / (u (E + works)), steps of 1e-4 to 0.3 s, Newton "
                 "stopped at 1e-2 to 1e-6",
       .unit = "u",
       .bound = {.upper = 8.0,
                 .derivation =
                     "increments of positions and strains are rounded by a few "
                     "u of their terms, each once and multiplied by the stress "
                     "they work against"},
       .measure = ResidualWork});
  claims.push_back(
      {.id = "laws/joint_work",
       .sentence = "The force in a shared point does no work, and the point "
                   "does not come apart.",
       .equations = "(PNT-1), (EM-9); paper (20), (21), (30), (31)",
       .reference = Reference::kExact,
       .metric = "as labelled, largest of 2000 steps of 0.01 s",
       .unit = "u",
       .bound = {.upper = 16.0,
                 .derivation =
                     "corrections stop at 4 u |w|, and three rates are summed "
                     "with weights of 1.5; openings of 10 u dt |w| in a step "
                     "add up, as a random walk of 2000, to 10 u of a metre"},
       .measure = JointWork});
  return claims;
}

}  // namespace emmy::verification
