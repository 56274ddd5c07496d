#include "emmy/integrate/batch_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/double_double.h"
#include "emmy/numerics/extrapolation.h"

namespace emmy {
namespace {

// Entries [first, first + kEntries) of a vector into a lane, and back.
template <size_t kEntries>
void Scatter(const double* from, int lane, Lanes (&to)[kEntries]) {
  for (size_t i = 0; i < kEntries; ++i) to[i][lane] = from[i];
}

template <size_t kEntries>
void Gather(const Lanes (&from)[kEntries], int lane, double* to) {
  for (size_t i = 0; i < kEntries; ++i) to[i] = from[i][lane];
}

template <size_t kEntries>
void Load(const CompensatedVector& from, Eigen::Index offset, int lane,
          CompensatedLanes<kEntries>* to) {
  Scatter(from.value.data() + offset, lane, to->value);
  Scatter(from.compensation.data() + offset, lane, to->compensation);
}

template <size_t kEntries>
void Store(const CompensatedLanes<kEntries>& from, int lane,
           Eigen::Index offset, CompensatedVector* to) {
  Gather(from.value, lane, to->value.data() + offset);
  Gather(from.compensation, lane, to->compensation.data() + offset);
}

template <size_t kEntries, size_t kDifferences>
void Load(const Extrapolation& from, Eigen::Index offset, int lane,
          ExtrapolationLanes<kEntries, kDifferences>* to) {
  Scatter(from.next.data() + offset, lane, to->next);
  for (size_t j = 0; j < kDifferences; ++j) {
    for (size_t i = 0; i < kEntries; ++i) {
      to->difference[j][i][lane] = from.differences(
          offset + static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

// What a batch does not keep is zero.
template <size_t kEntries, size_t kDifferences>
void Store(const ExtrapolationLanes<kEntries, kDifferences>& from, int lane,
           Eigen::Index offset, Extrapolation* to) {
  Gather(from.next, lane, to->next.data() + offset);
  to->differences.middleRows<static_cast<int>(kEntries)>(offset).setZero();
  for (size_t j = 0; j < kDifferences; ++j) {
    for (size_t i = 0; i < kEntries; ++i) {
      to->differences(offset + static_cast<Eigen::Index>(i),
                      static_cast<Eigen::Index>(j)) =
          from.difference[j][i][lane];
    }
  }
}

void Load(const ModelBody& body, const State& state, int lane,
          CentreLanes* centre) {
  Load(state.position, body.position_offset, lane, &centre->position);
  Load(state.velocity, body.velocity_offset, lane, &centre->velocity);
  centre->alive[lane] = 1.0;
  centre->iterations[lane] = 0.0;
  centre->one_round[lane] = true;
}

// The sums and predictions of a step, as the kernels make them.
template <size_t kEntries>
void Add(const double* increment, int lane, CompensatedLanes<kEntries>* to) {
  for (size_t i = 0; i < kEntries; ++i) {
    AddCompensated(increment[i], to->value[i][lane], to->compensation[i][lane]);
  }
}

void AdvanceCentre(const BatchStep& step, int lane, CentreLanes* centre) {
  for (size_t i = 0; i < 3; ++i) {
    const double change = step.velocity_increment[i];
    const double mean = centre->velocity.value[i][lane] +
                        (centre->velocity.compensation[i][lane] + 0.5 * change);
    const SumAndError product = TwoProduct(step.time_step, mean);
    AddCompensated(product.sum, product.error, centre->position.value[i][lane],
                   centre->position.compensation[i][lane]);
  }
  Add(step.velocity_increment, lane, &centre->velocity);
}

// Orders that are not kept are not taken: with differences of zero they would
// have missed by as much as the highest that is, which comes first.
template <size_t kEntries, size_t kDifferences>
void Predict(const BatchStep& step, const double* change, int lane,
             ExtrapolationLanes<kEntries, kDifferences>* kept) {
  constexpr auto kSize = static_cast<Eigen::Index>(kEntries);
  Extrapolation extrapolation;
  extrapolation.SetZero(kSize);
  Store(*kept, lane, 0, &extrapolation);
  Extrapolation::Errors errors{};
  extrapolation.Add(
      0, Eigen::Map<const VectorXd>(change, kSize) * step.inverse_time_step,
      &errors);
  extrapolation.Predict(0, kSize, Extrapolation::BestOrder(errors));
  Load(extrapolation, 0, lane, kept);
}

}  // namespace

void SetConstants(const AncfRigidBody& body, double time_step, int lane,
                  AncfBlock* block) {
  const Vector3d moment = body.second_moment().diagonal();
  const Vector6d& b = body.penalty_stiffness();
  const Vector6d c = (0.25 * time_step * time_step) * b;
  const Vector6d impulse = time_step * b;
  Scatter(moment.data(), lane, block->moment);
  Scatter(impulse.data(), lane, block->impulse);
  double share_square = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    const double inverse = 1.0 / (moment(i) + c(i));
    block->normal_inverse[k][lane] = inverse;
    block->normal_share[k][lane] = c(i) * inverse;
    const auto [m, n] = AncfRigidBody::kShearPairs[k];
    const double shear = c(3 + i);
    const double determinant =
        moment(m) * moment(n) + shear * (moment(m) + moment(n));
    const double first = moment(n) / determinant;
    const double second = moment(m) / determinant;
    block->shear_first[k][lane] = first;
    block->shear_second[k][lane] = second;
    block->shear_coupling[k][lane] = shear / determinant;
    block->first_share[k][lane] = shear * first;
    block->second_share[k][lane] = shear * second;
    block->first_moment[k][lane] = 0.5 * first + shear / determinant;
    block->second_moment[k][lane] = 0.5 * second + shear / determinant;
    // A shear is the sum of two entries.
    share_square =
        std::max({share_square, c(i) * inverse * c(i) * inverse,
                  2.0 * shear * shear * (first * first + second * second)});
  }
  const double smallest = moment.minCoeff();
  const double second_order =
      std::abs(time_step) * (1.0 + c.maxCoeff() / smallest);
  block->share_square[lane] = share_square;
  const double stiffening = c.maxCoeff() / smallest;
  block->stiffening_square[lane] = stiffening * stiffening;
  block->second_order_square[lane] = second_order * second_order;
}

void SetConstants(const ConventionalRigidBody& body, double time_step, int lane,
                  ConventionalBlock* block) {
  const Vector3d inertia = body.tensor().diagonal();
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    const DoubleDouble coupling = DoubleDouble(time_step) *
                                  (DoubleDouble(inertia((i + 2) % 3)) -
                                   DoubleDouble(inertia((i + 1) % 3))) /
                                  DoubleDouble(inertia(i));
    block->coupling[k][lane] = coupling.hi;
    block->coupling_low[k][lane] = coupling.lo;
    largest = std::max(largest, std::abs(coupling.hi));
  }
  block->coupling_square[lane] = 2.0 * largest * largest;
}

void LoadLane(const ModelBody& body, const State& state, int lane,
              AncfBlock* block) {
  Load(body, state, lane, &block->centre);
  Load(state.position, body.position_offset + 3, lane, &block->gradients);
  Load(state.velocity, body.velocity_offset + 3, lane, &block->rates);
  Load(state.strain, body.strain_offset, lane, &block->strain);
  Load(state.acceleration, body.velocity_offset + 3, lane,
       &block->acceleration);
}

void LoadLane(const ModelBody& body, const State& state, int lane,
              ConventionalBlock* block) {
  Load(body, state, lane, &block->centre);
  Load(state.position, body.position_offset + 3, lane, &block->quaternion);
  Load(state.velocity, body.velocity_offset + 3, lane,
       &block->angular_velocity);
  Load(state.acceleration, body.velocity_offset + 3, lane,
       &block->acceleration);
}

void StoreLane(const AncfBlock& block, int lane, const ModelBody& body,
               State* state) {
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  Store(block.centre.position, lane, q, &state->position);
  Store(block.centre.velocity, lane, w, &state->velocity);
  Store(block.gradients, lane, q + 3, &state->position);
  Store(block.rates, lane, w + 3, &state->velocity);
  Store(block.strain, lane, body.strain_offset, &state->strain);
  Store(block.acceleration, lane, w + 3, &state->acceleration);
}

void StoreLane(const ConventionalBlock& block, int lane, const ModelBody& body,
               State* state) {
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  Store(block.centre.position, lane, q, &state->position);
  Store(block.centre.velocity, lane, w, &state->velocity);
  Store(block.quaternion, lane, q + 3, &state->position);
  Store(block.angular_velocity, lane, w + 3, &state->velocity);
  Store(block.acceleration, lane, w + 3, &state->acceleration);
}

BodyStepResult TakeOrdinaryStep(const AncfBodyStep& body_step,
                                const BatchStep& step, int lane,
                                AncfBlock* block) {
  AncfBodyStart start;
  Gather(block->gradients.value, lane, start.gradients.data());
  Gather(block->gradients.compensation, lane,
         start.gradients_compensation.data());
  Gather(block->rates.value, lane, start.rates.data());
  Gather(block->rates.compensation, lane, start.rates_compensation.data());
  Gather(block->strain.value, lane, start.strain.data());
  Gather(block->strain.compensation, lane, start.strain_compensation.data());
  Matrix3d guess;
  Gather(block->acceleration.next, lane, guess.data());
  guess *= step.time_step;
  AncfBodyIncrement increment;
  const BodyStepResult result = body_step.Solve(start, guess, &increment);
  block->centre.iterations[lane] += result.iterations;
  if (result.termination != Termination::kConverged) return result;
  AdvanceCentre(step, lane, &block->centre);
  Add(increment.gradients.data(), lane, &block->gradients);
  Add(increment.rates.data(), lane, &block->rates);
  Add(increment.strain.data(), lane, &block->strain);
  Predict(step, increment.rates.data(), lane, &block->acceleration);
  return result;
}

BodyStepResult TakeOrdinaryStep(const ConventionalBodyStep& body_step,
                                const BatchStep& step, int lane,
                                ConventionalBlock* block) {
  ConventionalBodyStart start;
  Gather(block->quaternion.value, lane, start.quaternion.data());
  Gather(block->quaternion.compensation, lane,
         start.quaternion_compensation.data());
  Gather(block->angular_velocity.value, lane, start.angular_velocity.data());
  Gather(block->angular_velocity.compensation, lane,
         start.angular_velocity_compensation.data());
  Vector3d guess;
  Gather(block->acceleration.next, lane, guess.data());
  guess *= step.time_step;
  ConventionalBodyIncrement increment;
  const BodyStepResult result = body_step.Solve(start, guess, &increment);
  block->centre.iterations[lane] += result.iterations;
  if (result.termination != Termination::kConverged) return result;
  AdvanceCentre(step, lane, &block->centre);
  Add(increment.quaternion.data(), lane, &block->quaternion);
  for (size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    AddCompensated(increment.angular_velocity(k),
                   increment.angular_velocity_low(k),
                   block->angular_velocity.value[i][lane],
                   block->angular_velocity.compensation[i][lane]);
  }
  Predict(step, increment.angular_velocity.data(), lane, &block->acceleration);
  return result;
}

}  // namespace emmy
