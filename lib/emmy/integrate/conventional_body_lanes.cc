// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/conventional_body_lanes.h"

#include <algorithm>
#include <cmath>

#include "emmy/base/double_double.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/conventional_body_lanes.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/body_lanes-inl.h"
#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "emmy/numerics/unit_roundoff.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// Rows of the inverse of the matrix that has a unit diagonal, `next` at
// (i, i + 1) and `previous` at (i, i + 2), cyclic, in the same form.
struct CyclicInverse {
  Lanes diagonal, next, previous;
};

HWY_INLINE CyclicInverse Inverse(const Lanes& u, const Lanes& v) {
  const Lanes one = Lanes::Set(1.0);
  const Lanes u1 = Next(u);
  const Lanes u2 = Previous(u);
  const Lanes v1 = Next(v);
  const Lanes v2 = Previous(v);
  const Lanes minor = one - u1 * v2;
  const Lanes determinant = minor + (u * (u1 * u2 - v1) + v * (v1 * v2 - u2));
  const Lanes scale = one / determinant;
  return {minor * scale, (v * v2 - u) * scale, (u * u1 - v) * scale};
}

// Δq = q₀ ⊗ (cay(Θ) − 1), (ROT-5).
HWY_INLINE Lanes CayleyIncrement(const Lanes& q, const Lanes& theta) {
  alignas(32) double t[4];
  theta.Store(t);
  const double quarter_square =
      0.25 * ((t[1] * t[1] + t[2] * t[2]) + t[3] * t[3]);
  const double n = std::sqrt(1.0 + quarter_square);
  const double scale = 0.5 / n;
  // q times the units i, j and k.
  const Lanes q_i = SwapInPairs(q) * Lanes::Signs(-1, 1, 1, -1);
  const Lanes q_j = SwapPairs(q) * Lanes::Signs(-1, -1, 1, 1);
  const Lanes q_k = SwapPairs(SwapInPairs(q)) * Lanes::Signs(-1, 1, -1, 1);
  return (Lanes::Set(scale * t[1]) * q_i + Lanes::Set(scale * t[2]) * q_j) +
         (Lanes::Set(scale * t[3]) * q_k -
          Lanes::Set(quarter_square / (n * (1.0 + n))) * q);
}

// The angular velocity has three numbers; the one in front is the centre's.
constexpr int kQuaternion = 3;
constexpr int kRate = 2;

// What the first lane holds is not meaningful but of the quaternion.
struct Increment {
  Lanes quaternion, rates, rates_low;
};

HWY_INLINE BodyStepResult SolveBody(const ConventionalBodyLanes& body,
                                    const BodyStartNumbers& start,
                                    Increment* increment) {
  const Lanes step = Lanes::Set(body.time_step);
  const Lanes half = Lanes::Set(0.5);
  const Lanes w0 = Lanes::Load(start.velocity + kRate);
  const Lanes w_low = Lanes::Load(start.velocity_low + kRate);
  const Lanes gyration = Lanes::Load(body.gyration);
  const Lanes half_gyration = Lanes::Load(body.half_gyration);
  const Lanes moment = Lanes::Load(body.moment);
  BodyStepResult result;
  Lanes dw = step * Lanes::Load(start.next + kRate);
  Lanes low = Lanes::Set(0.0);
  for (int i = 1;; ++i) {
    // W̄ as a pair.
    const LanesSum increments = TwoSum(w_low, half * dw);
    const LanesSum mean = TwoSum(w0, increments.value);
    const Lanes mean_low = mean.error + increments.error;
    const Lanes mean_next = Next(mean.value);
    const Lanes mean_previous = Previous(mean.value);

    const LanesSum product = TwoProduct(mean_next, mean_previous);
    const Lanes product_low = product.error + (mean_next * Previous(mean_low) +
                                               mean_previous * Next(mean_low));
    const LanesSum gyroscopic = TwoProduct(gyration, product.value);
    const Lanes gyroscopic_low =
        gyroscopic.error + (gyration * product_low +
                            Lanes::Load(body.gyration_low) * product.value);
    const LanesSum change = TwoProduct(moment, dw);
    const LanesSum sum = TwoSum(change.value, gyroscopic.value);
    const Lanes residual =
        sum.value + (sum.error + (change.error + gyroscopic_low));

    const CyclicInverse inverse =
        Inverse(half_gyration * mean_previous, half_gyration * mean_next);
    const Lanes y = Lanes::Load(body.inverse_moment) * residual;
    const Lanes correction =
        inverse.diagonal * y +
        (inverse.next * Next(y) + inverse.previous * Previous(y));
    const LanesSum better = TwoSum(dw, Lanes::Set(0.0) - correction);
    dw = better.value;
    low = better.error;

    result.iterations = i;
    const double size = LargestOfBody(Abs(correction));
    result.correction = size;
    bool done = false;
    if (body.options.tolerance.has_value()) {
      done = size <= *body.options.tolerance * LargestOfBody(Abs(mean.value));
    } else {
      // (CRBL-2). Of one sign, it may add up for a million steps.
      const double left =
          (3.0 * body.largest_gyration * size + 32.0 * kUnitRoundoff) * size;
      done = left <= 0x1p-20 * kUnitRoundoff * LargestOfBody(Abs(dw));
    }
    if (done) break;
    constexpr int kEnough = 4;
    if (i >= std::min(kEnough, body.options.max_iterations)) return result;
  }

  const Lanes theta = step * (w0 + (w_low + half * dw));
  const Lanes change =
      CayleyIncrement(Lanes::Load(start.position + kQuaternion), theta);
  *increment = {change, dw, low};
  // What is not finite in one of them is not in the sum either.
  const Lanes sum = change + theta;
  const bool is_finite =
      IsFiniteOfBody(sum) && IsFiniteOfBody(SwapInPairs(change));
  result.termination =
      is_finite ? Termination::kConverged : Termination::kNonFinite;
  return result;
}

HWY_INLINE void CommitBody(const Increment& increment, double time_step,
                           const CentreIncrement& centre_increment,
                           const BodyNumbers& numbers) {
  double* const position = numbers.position;
  double* const position_low = numbers.position_low;
  double* const velocity = numbers.velocity;
  double* const velocity_low = numbers.velocity_low;
  const Lanes centre = Lanes::Load(centre_increment.value);
  const LanesSum motion =
      CentreMotion(centre, velocity, velocity_low, Lanes::Set(time_step));
  const LanesSum quaternion =
      TwoSum(Lanes::Load(position + kQuaternion),
             increment.quaternion + Lanes::Load(position_low + kQuaternion));
  const LanesSum centre_velocity =
      TwoSum(Lanes::Load(velocity), centre + Lanes::Load(velocity_low));
  const Lanes rates = WithoutFirst(increment.rates);
  const Lanes low = WithoutFirst(increment.rates_low);
  const LanesSum first = TwoSum(Lanes::Load(velocity + kRate), rates);
  const LanesSum second = TwoSum(
      first.value, first.error + (Lanes::Load(velocity_low + kRate) + low));

  // All has been read before the first is written: what lies across the end of
  // a vector that was just written has to wait until that is in the cache.
  AddPairTo(motion, position, position_low);
  quaternion.value.Store(position + kQuaternion);
  quaternion.error.Store(position_low + kQuaternion);
  centre_velocity.value.Store(velocity);
  centre_velocity.error.Store(velocity_low);
  SelectFirst(Broadcast<kRate>(centre_velocity.value), second.value)
      .Store(velocity + kRate);
  SelectFirst(Broadcast<kRate>(centre_velocity.error), second.error)
      .Store(velocity_low + kRate);

  const Lanes accelerations[1] = {Lanes::Set(1.0 / time_step) * rates};
  double* differences[Extrapolation::kOrders];
  for (int j = 0; j < Extrapolation::kOrders; ++j) {
    differences[j] = numbers.differences[j] + kRate;
  }
  Extrapolate(accelerations, differences, numbers.next + kRate);
}

BodyStepResult SolveConventional(const ConventionalBodyLanes& body,
                                 const BodyStartNumbers& start,
                                 ConventionalLanesIncrement* increment) {
  Increment lanes = {Lanes::Set(0.0), Lanes::Set(0.0), Lanes::Set(0.0)};
  const BodyStepResult result = SolveBody(body, start, &lanes);
  lanes.quaternion.Store(increment->quaternion);
  lanes.rates.Store(increment->angular_velocity);
  lanes.rates_low.Store(increment->angular_velocity_low);
  return result;
}

void CommitConventional(const ConventionalLanesIncrement& increment,
                        double time_step,
                        const CentreIncrement& centre_increment,
                        const BodyNumbers& numbers) {
  CommitBody({Lanes::Load(increment.quaternion),
              Lanes::Load(increment.angular_velocity),
              Lanes::Load(increment.angular_velocity_low)},
             time_step, centre_increment, numbers);
}

BodyStepResult AdvanceConventional(const ConventionalBodyLanes& body,
                                   const BodyStartNumbers& start,
                                   const CentreIncrement& centre,
                                   const BodyNumbers& numbers) {
  Increment increment = {Lanes::Set(0.0), Lanes::Set(0.0), Lanes::Set(0.0)};
  const BodyStepResult result = SolveBody(body, start, &increment);
  if (result.termination == Termination::kConverged) {
    CommitBody(increment, body.time_step, centre, numbers);
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(SolveConventional);
HWY_EXPORT(CommitConventional);
HWY_EXPORT(AdvanceConventional);

bool ConventionalBodyLanes::Fits(const ConventionalRigidBody& body) {
  const Matrix3d diagonal = body.tensor().diagonal().asDiagonal();
  return body.tensor() == diagonal;
}

ConventionalBodyLanes::ConventionalBodyLanes(const ConventionalRigidBody& body,
                                             double step,
                                             const NewtonOptions& newton)
    : time_step(step), options(newton), largest_gyration(0.0) {
  const Vector3d moments = body.tensor().diagonal();
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble difference =
        DoubleDouble(TwoSum(moments((i + 2) % 3), -moments((i + 1) % 3)));
    const DoubleDouble product = DoubleDouble(step) * difference;
    moment[1 + i] = moments(i);
    inverse_moment[1 + i] = 1.0 / moments(i);
    gyration[1 + i] = product.hi;
    gyration_low[1 + i] = product.lo;
    half_gyration[1 + i] = 0.5 * product.hi / moments(i);
    largest_gyration =
        std::max(largest_gyration, std::abs(product.hi / moments(i)));
  }
}

void ConventionalLanesIncrement::Set(
    const ConventionalBodyIncrement& increment) {
  std::copy_n(increment.quaternion.data(), 4, quaternion);
  std::copy_n(increment.angular_velocity.data(), 3, angular_velocity + 1);
  std::copy_n(increment.angular_velocity_low.data(), 3,
              angular_velocity_low + 1);
}

BodyStepResult SolveInLanes(const ConventionalBodyLanes& lanes,
                            const ModelBody& body, const State& state,
                            ConventionalLanesIncrement* increment) {
  return HWY_DYNAMIC_DISPATCH(SolveConventional)(
      lanes, BodyStartNumbers(body, state), increment);
}

void CommitInLanes(const ConventionalLanesIncrement& increment,
                   double time_step, const CentreIncrement& centre,
                   const ModelBody& body, State& state) {
  HWY_DYNAMIC_DISPATCH(CommitConventional)
  (increment, time_step, centre, BodyNumbers(body, state));
}

BodyStepResult AdvanceInLanes(const ConventionalBodyLanes& lanes,
                              const CentreIncrement& centre,
                              const ModelBody& body, State& state) {
  return HWY_DYNAMIC_DISPATCH(AdvanceConventional)(
      lanes, BodyStartNumbers(body, state), centre, BodyNumbers(body, state));
}

}  // namespace emmy
#endif  // HWY_ONCE
