// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/ancf_body_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/ancf_body_lanes.cc"
// Vectors of a length unknown to the compiler cannot be members.
#define HWY_DISABLED_TARGETS \
  (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/body_lanes-inl.h"
#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "emmy/numerics/vector_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2.0;

// A step is one long chain of operations that wait for each other. What the
// chain need not wait for is taken out of it: halves are carried instead of
// being formed, which is exact.
BodyStepResult Solve(const AncfBodyLanes& body, const double* position,
                     const double* position_compensation,
                     const double* velocity,
                     const double* velocity_compensation, const double* strain,
                     const double* strain_compensation,
                     const double* acceleration,
                     AncfLanesIncrement* HWY_RESTRICT increment) {
  const double dt = body.time_step;
  const Lanes step = Lanes::Set(dt);
  const Lanes half_step = Lanes::Set(0.5 * dt);
  const Vectors w0 = LoadVectors(velocity);
  const Vectors w_low = LoadVectors(velocity_compensation);
  const Vectors e0 = LoadVectors(position);
  const Vectors e_low = LoadVectors(position_compensation);
  const Lanes stretch0 = LoadFromSecond(strain);
  const Lanes stretch_low = LoadFromSecond(strain_compensation);
  // The first lane holds ε₃ here and ε₄ above; both are multiplied by zero.
  const Lanes shear0 = Lanes::Load(strain + 2);
  const Lanes shear_low = Lanes::Load(strain_compensation + 2);

  BodyStepResult result;
  StagnationMonitor strain_monitor(0x1p-6);
  StagnationMonitor rotation_monitor;
  Vectors half_dw = half_step * LoadVectors(acceleration);
  for (int i = 1;; ++i) {
    const Vectors mean_w = w0 + (w_low + half_dw);
    const Vectors half_de = half_step * mean_w;
    const Vectors e = e0 + (e_low + half_de);  // ē
    const Vectors e_next = Next(e);
    const Vectors e_previous = Previous(e);
    const Lanes half_stretch = Dot(e, half_de);
    const Lanes half_shear = Dot(e_next, half_de) + Dot(e, Next(half_de));
    const Lanes mean_stretch = stretch0 + (stretch_low + half_stretch);
    const Lanes mean_shear = shear0 + (shear_low + half_shear);
    const Lanes stretch_stress = Lanes::Load(body.stretch) * mean_stretch;
    const Lanes shear_stress = Lanes::Load(body.shear) * mean_shear;
    const Vectors force = (stretch_stress * e + shear_stress * e_next) +
                          Previous(shear_stress) * e_previous;
    // (EM-2)
    const Vectors residual =
        Lanes::Load(body.twice_moment) * half_dw + step * force;
    const Vectors normal = Cross(e_next, e_previous);
    // Not zero in the lane that means nothing.
    const Lanes volume = Dot(e, normal) + Lanes::First(1.0);
    const Vectors dual = (Lanes::Set(1.0) / volume) * normal;
    const Vectors dual_next = Next(dual);
    const Vectors dual_previous = Previous(dual);

    // Half of (EM-6): of a pair (m, n), p is rₘ along ēⁿ and q is rₙ along ēᵐ.
    const Lanes p = Dot(residual, dual_next);
    const Lanes q = Dot(residual, dual_previous);
    const Lanes turning = p - Next(q);
    const Lanes x_own = Lanes::Load(body.half_inverse) * Dot(residual, dual);
    const Lanes x_next = Lanes::Load(body.half_first) * p +
                         Lanes::Load(body.half_shear) * turning;
    const Lanes x_previous =
        Lanes::Load(body.half_second) * q -
        Lanes::Load(body.half_shear_previous) * (Previous(p) - q);
    const Vectors own = x_own * dual;
    const Vectors others = x_next * dual_next + x_previous * dual_previous;
    half_dw = (half_dw - own) - others;

    result.iterations = i;
    result.correction = 2.0 * LargestOfBody(MaxAbs(own + others));
    const double rate = LargestOfBody(MaxAbs(mean_w));
    bool done = false;
    if (body.options.tolerance.has_value()) {
      done = result.correction <= *body.options.tolerance * rate;
    } else {
      const double strain_floor =
          4.0 * kUnitRoundoff * rate;  // AncfBodyStep's.
      const bool strain_done =
          strain_monitor.Update(result.correction, strain_floor);
      constexpr double kNear = 1e4;
      if (result.correction <= kNear * strain_floor) {
        const double deformation =
            LargestOfBody(Max(Abs(mean_stretch), Abs(mean_shear)));
        const double stress =
            LargestOfBody(Max(Abs(stretch_stress), Abs(shear_stress)));
        const double rotation_floor =
            kUnitRoundoff * (2.0 * LargestOfBody(MaxAbs(half_dw)) +
                             std::abs(dt) * stress / body.smallest_moment_sum);
        const bool rotation_done = rotation_monitor.Update(
            LargestOfBody(Abs(turning)) / body.smallest_moment_sum,
            rotation_floor);
        // (LANE-2) with ‖w̄‖² and ‖ε̄‖, from their largest entries.
        const double turn = 1.5 * std::abs(dt) * rate;
        const double strain_left = 2.0 * turn * result.correction;
        const double rotation_left =
            (turn * turn + 3.0 * deformation +
             0.75 * dt * dt * stress / body.smallest_moment_sum) *
            result.correction;
        done = (strain_done || strain_left <= 0x1p-6 * strain_floor) &&
               (rotation_done || rotation_left <= 0x1p-6 * rotation_floor);
      }
    }
    if (done) break;
    // A handful of iterations is what this tangent is for.
    constexpr int kEnough = 12;
    if (i >= std::min(kEnough, body.options.max_iterations)) return result;
  }

  const VectorsAndError de = ScaledExactly(step, w0 + (w_low + half_dw));
  const Vectors e = e0 + (e_low + Lanes::Set(0.5) * de.value);
  const auto [stretch, shear] = StrainIncrementsOf(e, de);
  const Vectors dw = half_dw + half_dw;
  StoreInterleaved(de.value.x, de.value.y, de.value.z, increment->gradients);
  StoreInterleaved(dw.x, dw.y, dw.z, increment->rates);
  // In this order: the lane that means nothing is overwritten.
  shear.Store(increment->strain + 3);
  stretch.Store(increment->strain);
  // What is not finite in one of them is not in the sum either.
  const Lanes sum = (dw.x + dw.y) + (dw.z + (stretch + shear));
  result.termination = LargestOfBody(Abs(sum - sum)) == 0.0
                           ? Termination::kConverged
                           : Termination::kNonFinite;
  return result;
}

void Commit(const AncfLanesIncrement& increment, double time_step,
            const double* velocity_increment, double* position,
            double* position_compensation, double* velocity,
            double* velocity_compensation, double* strain,
            double* strain_compensation, double* next,
            double* const* differences) {
  const Lanes step = Lanes::Set(time_step);
  // The centre's, in the lanes before the first of e₁.
  const Lanes centre = Lanes::Load(velocity_increment);
  const Lanes mean_velocity =
      Lanes::Load(velocity) +
      (Lanes::Load(velocity_compensation) + Lanes::Set(0.5) * centre);
  MoveCentre(Lanes::Load(increment.gradients), mean_velocity, step, position,
             position_compensation);
  AddTo(SelectLast(centre, Lanes::Load(increment.rates)), velocity,
        velocity_compensation);
  for (int i = 4; i < 12; i += 4) {
    AddTo(Lanes::Load(increment.gradients + i), position + i,
          position_compensation + i);
    AddTo(Lanes::Load(increment.rates + i), velocity + i,
          velocity_compensation + i);
  }
  // Six numbers: the middle two are added twice, to what they were before.
  const LanesSum low =
      TwoSum(Lanes::Load(strain), Lanes::Load(increment.strain + 1) +
                                      Lanes::Load(strain_compensation));
  const LanesSum high =
      TwoSum(Lanes::Load(strain + 2), Lanes::Load(increment.strain + 3) +
                                          Lanes::Load(strain_compensation + 2));
  low.value.Store(strain);
  low.error.Store(strain_compensation);
  high.value.Store(strain + 2);
  high.error.Store(strain_compensation + 2);

  Lanes accelerations[3];
  for (int i = 0; i < 3; ++i) {
    accelerations[i] =
        Lanes::Set(1.0 / time_step) * Lanes::Load(increment.rates + 4 * i);
  }
  accelerations[0] = SelectLast(Lanes::Set(0.0), accelerations[0]);
  Extrapolate(accelerations, differences, next);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(Solve);
HWY_EXPORT(Commit);

bool AncfBodyLanes::Fits(const AncfRigidBody& body) {
  const Matrix3d& moment = body.second_moment();
  const Matrix3d diagonal = moment.diagonal().asDiagonal();
  return moment == diagonal;
}

AncfBodyLanes::AncfBodyLanes(const AncfRigidBody& body, double step,
                             const NewtonOptions& newton)
    : time_step(step), options(newton) {
  const Vector3d moments = body.second_moment().diagonal();
  smallest_moment_sum = moments.sum() - moments.maxCoeff();
  const double quarter = 0.25 * step * step;
  for (int i = 0; i < 3; ++i) {
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double b = body.penalty_stiffness()(i);
    const double c = quarter * body.penalty_stiffness()(3 + i);
    const int next = 1 + (i + 1) % 3;
    twice_moment[1 + i] = 2.0 * moments(i);
    stretch[1 + i] = b;
    shear[1 + i] = body.penalty_stiffness()(3 + i);
    half_inverse[1 + i] = 0.5 / (moments(i) + quarter * b);
    // The determinant without the cancellation of c² − c².
    const double determinant =
        moments(m) * moments(n) + c * (moments(m) + moments(n));
    half_first[1 + i] = 0.5 * moments(n) / determinant;
    half_second[next] = 0.5 * moments(m) / determinant;
    half_shear[1 + i] = 0.5 * c / determinant;
    half_shear_previous[next] = half_shear[1 + i];
  }
}

void AncfLanesIncrement::Set(const AncfBodyIncrement& increment) {
  std::copy_n(increment.gradients.data(), 9, gradients + 3);
  std::copy_n(increment.rates.data(), 9, rates + 3);
  std::copy_n(increment.strain.data(), 6, strain + 1);
}

BodyStepResult SolveInLanes(const AncfBodyLanes& lanes, const ModelBody& body,
                            const State& state, AncfLanesIncrement* increment) {
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  const Eigen::Index s = body.strain_offset;
  return HWY_DYNAMIC_DISPATCH(Solve)(
      lanes, state.position.value.data() + q,
      state.position.compensation.data() + q, state.velocity.value.data() + w,
      state.velocity.compensation.data() + w, state.strain.value.data() + s,
      state.strain.compensation.data() + s, state.acceleration.next.data() + w,
      increment);
}

void CommitInLanes(const AncfLanesIncrement& increment, double time_step,
                   const Vector3d& gravity, const ModelBody& body,
                   State& state) {
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  const Eigen::Index s = body.strain_offset;
  const double velocity_increment[4] = {time_step * gravity(0),
                                        time_step * gravity(1),
                                        time_step * gravity(2), 0.0};
  double* differences[Extrapolation::kOrders];
  for (int j = 0; j < Extrapolation::kOrders; ++j) {
    differences[j] = &state.acceleration.differences(w, j);
  }
  HWY_DYNAMIC_DISPATCH(Commit)
  (increment, time_step, velocity_increment, state.position.value.data() + q,
   state.position.compensation.data() + q, state.velocity.value.data() + w,
   state.velocity.compensation.data() + w, state.strain.value.data() + s,
   state.strain.compensation.data() + s, state.acceleration.next.data() + w,
   differences);
}

}  // namespace emmy
#endif  // HWY_ONCE
