// One step of several free conventional bodies in principal axes, one a lane.
//
// The residual is that of (CRB-4), divided by Jᵢ. The Jacobian (CRB-5) is then
// 1 + O with Oᵢⱼ = ½ Δt (J_k − J_j)/Jᵢ W̄_k, and so on, of the size ½ |W|Δt;
// its inverse is taken as 1 − O + O², which leaves (½ |W|Δt)³ of a
// correction.                                                      (BATCH-3)

#if defined(EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_) == \
    defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_
#undef EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_
#else
#define EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_
#endif

#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/lane_pack-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

HWY_INLINE Pack3 Times(const Pack3& a, const Pack3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

class ConventionalPackStep {
 public:
  HWY_INLINE ConventionalPackStep(const BatchStep& step, int lane,
                                  ConventionalBlock* block)
      : step_(step),
        lane_(lane),
        block_(*block),
        inertia_(Load3(block->inertia, lane)) {}

  // Advances the lanes that are alive and converge; returns the others.
  HWY_INLINE Flag Advance() {
    const Flag alive = Broadcast(0.0) < Load(block_.centre.alive + lane_);
    Pack3 change;
    const Flag done = Solve(alive, &change);
    if (All(done)) {
      Commit(Writer<true>(done), change);
    } else {
      Commit(Writer<false>(done), change);
    }
    return Without(alive, done);
  }

 private:
  static constexpr int kMaxIterations = 12;

  // W̄
  HWY_INLINE Pack3 Mean(const Pack3& change) const {
    return Load3(block_.angular_velocity.value, lane_) +
           (Load3(block_.angular_velocity.compensation, lane_) +
            Broadcast(0.5) * change);
  }

  // O v, its factors by axis.
  static HWY_INLINE Pack3 OffDiagonal(const Pack3& coupling, const Pack3& mean,
                                      const Pack3& v) {
    return {coupling.x * (mean.z * v.y + mean.y * v.z),
            coupling.y * (mean.x * v.z + mean.z * v.x),
            coupling.z * (mean.y * v.x + mean.x * v.y)};
  }

  HWY_INLINE Flag Solve(Flag alive, Pack3* result) {
    const Pack time_step = Broadcast(step_.time_step);
    const Pack3 inverse = Load3(block_.inverse_inertia, lane_);
    const Pack3 coupling = Load3(block_.coupling, lane_);
    Pack3 change = time_step * Load3(block_.acceleration.next, lane_);
    Flag active = alive;
    Flag failed = Without(alive, alive);
    PackMonitor monitor(0x1p-10);
    Pack floor = Broadcast(0.0);
    Pack previous = floor;
    Pack3 first_mean = change;
    Pack iterations = Load(block_.centre.iterations + lane_);
    for (int i = 0; i < kMaxIterations; ++i) {
      iterations = iterations + OrZero(active, Broadcast(1.0));
      const Pack3 mean = Mean(change);
      const Pack3 momentum = Times(inertia_, mean);
      const Pack3 residual =
          Times(inertia_, change) + time_step * Cross(mean, momentum);
      if (i == 0) {
        first_mean = mean;
        floor =
            Broadcast(0x1p-53) *
            (MaxAbsolute(change) +
             Absolute(time_step) * (MaxAbsolute(mean) * MaxAbsolute(momentum)) *
                 Load(block_.inverse_smallest_inertia + lane_));
      }
      const Pack3 scaled = Times(inverse, residual);
      const Pack3 once = scaled - OffDiagonal(coupling, first_mean, scaled);
      const Pack3 correction = scaled - OffDiagonal(coupling, first_mean, once);
      change = Choose(active, change - correction, change);
      const Pack size = MaxAbsolute(correction);
      const Flag done =
          And(monitor.Update(size, floor, i > 0), IsFinite(change));
      Flag slow = Without(alive, alive);
      if (i > 0) {
        slow = And(Broadcast(1e3) * floor < size,
                   Broadcast(0.3) * previous < size);
      }
      previous = size;
      active = Without(active, done);
      slow = And(active, slow);
      failed = Or(failed, slow);
      active = Without(active, slow);
      if (None(active)) break;
    }
    Store(iterations, block_.centre.iterations + lane_);
    *result = change;
    return Without(Without(alive, failed), active);
  }

  template <bool kAll>
  HWY_INLINE void Commit(const Writer<kAll>& writer, const Pack3& change) {
    AdvanceCentre(step_, writer, lane_, &block_.centre);
    // (ROT-5)
    const Pack3 theta = Broadcast(step_.time_step) * Mean(change);
    const Pack one = Broadcast(1.0);
    const Pack half = Broadcast(0.5);
    const Pack quarter_square = Broadcast(0.25) * Dot(theta, theta);
    const Pack n = SquareRoot(one + quarter_square);
    const Pack inverse = one / (n * (one + n));
    const Pack scalar = Broadcast(0.0) - quarter_square * inverse;
    // 1/n, without a second division.
    const Pack3 v = (half * ((one + n) * inverse)) * theta;
    CompensatedLanes<4>& q = block_.quaternion;
    const Pack w = Load(q.value[0] + lane_);
    const Pack3 u = Load3(q.value + 1, lane_);
    const Pack3 vector = (w * v + scalar * u) + Cross(u, v);
    writer.Add(w * scalar - Dot(u, v), q.value[0] + lane_,
               q.compensation[0] + lane_);
    writer.Add3(vector, q.value + 1, q.compensation + 1, lane_);
    writer.Add3(change, block_.angular_velocity.value,
                block_.angular_velocity.compensation, lane_);
    const Pack3 acceleration[1] = {Broadcast(step_.inverse_time_step) * change};
    Predict(acceleration, writer, lane_, &block_.acceleration);
  }

  const BatchStep& step_;
  int lane_;
  ConventionalBlock& block_;
  Pack3 inertia_;
};

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_
