// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/conventional_body_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emmy/base/double_double.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/conventional_body_lanes.cc"
// Vectors of a length unknown to the compiler cannot be members.
#define HWY_DISABLED_TARGETS \
  (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/body_lanes-inl.h"
#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
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

// `quaternion` to `acceleration` point at the body's four numbers: those of
// vectors have one in front that belongs to something else.
BodyStepResult SolveConventional(const ConventionalBodyLanes& body,
                                 const double* quaternion,
                                 const double* angular_velocity,
                                 const double* angular_velocity_low,
                                 const double* acceleration,
                                 ConventionalLanesIncrement* increment) {
  constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2.0;
  const Lanes step = Lanes::Set(body.time_step);
  const Lanes half = Lanes::Set(0.5);
  const Lanes w0 = Lanes::Load(angular_velocity);
  const Lanes w_low = Lanes::Load(angular_velocity_low);
  const Lanes gyration = Lanes::Load(body.gyration);
  const Lanes half_gyration = Lanes::Load(body.half_gyration);
  const Lanes moment = Lanes::Load(body.moment);
  BodyStepResult result;
  Lanes dw = step * Lanes::Load(acceleration);
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
  const Lanes change = CayleyIncrement(Lanes::Load(quaternion), theta);
  change.Store(increment->quaternion);
  dw.Store(increment->angular_velocity);
  low.Store(increment->angular_velocity_low);
  // What is not finite in one of them is not in the sum either.
  const Lanes sum = change + theta;
  result.termination = Largest(Abs(change - change)) == 0.0 &&
                               LargestOfBody(Abs(sum - sum)) == 0.0
                           ? Termination::kConverged
                           : Termination::kNonFinite;
  return result;
}

void CommitConventional(const ConventionalLanesIncrement& increment,
                        double time_step, const double* velocity_increment,
                        double* position, double* position_compensation,
                        double* velocity, double* velocity_compensation,
                        double* next, double* const* differences) {
  // The four numbers of the vector part begin with one of the centre.
  constexpr int kQuaternion = 3;
  constexpr int kRate = 2;
  const Lanes none = Lanes::Set(0.0);
  const Lanes centre = Lanes::Load(velocity_increment);
  const Lanes mean_velocity =
      Lanes::Load(velocity) +
      (Lanes::Load(velocity_compensation) + Lanes::Set(0.5) * centre);
  const LanesSum quaternion =
      TwoSum(Lanes::Load(position + kQuaternion),
             Lanes::Load(increment.quaternion) +
                 Lanes::Load(position_compensation + kQuaternion));
  // Its last number is the quaternion's first, which is written after it.
  MoveCentre(none, mean_velocity, Lanes::Set(time_step), position,
             position_compensation);
  quaternion.value.Store(position + kQuaternion);
  quaternion.error.Store(position_compensation + kQuaternion);

  AddTo(centre, velocity, velocity_compensation);
  const Lanes rates = WithoutFirst(Lanes::Load(increment.angular_velocity));
  const Lanes low = WithoutFirst(Lanes::Load(increment.angular_velocity_low));
  const LanesSum first = TwoSum(Lanes::Load(velocity + kRate), rates);
  const LanesSum second =
      TwoSum(first.value,
             first.error + (Lanes::Load(velocity_compensation + kRate) + low));
  second.value.Store(velocity + kRate);
  second.error.Store(velocity_compensation + kRate);

  const Lanes accelerations[1] = {Lanes::Set(1.0 / time_step) * rates};
  Extrapolate(accelerations, differences, next);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(SolveConventional);
HWY_EXPORT(CommitConventional);

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
  const Eigen::Index q = body.position_offset + 3;
  const Eigen::Index w = body.velocity_offset + 2;
  return HWY_DYNAMIC_DISPATCH(SolveConventional)(
      lanes, state.position.value.data() + q, state.velocity.value.data() + w,
      state.velocity.compensation.data() + w,
      state.acceleration.next.data() + w, increment);
}

void CommitInLanes(const ConventionalLanesIncrement& increment,
                   double time_step, const Vector3d& gravity,
                   const ModelBody& body, State& state) {
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  const double velocity_increment[4] = {time_step * gravity(0),
                                        time_step * gravity(1),
                                        time_step * gravity(2), 0.0};
  double* differences[Extrapolation::kOrders];
  for (int j = 0; j < Extrapolation::kOrders; ++j) {
    differences[j] = &state.acceleration.differences(w + 2, j);
  }
  HWY_DYNAMIC_DISPATCH(CommitConventional)
  (increment, time_step, velocity_increment, state.position.value.data() + q,
   state.position.compensation.data() + q, state.velocity.value.data() + w,
   state.velocity.compensation.data() + w,
   state.acceleration.next.data() + w + 2, differences);
}

}  // namespace emmy
#endif  // HWY_ONCE
