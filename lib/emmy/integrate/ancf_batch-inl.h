// One step of several free ANCF bodies in principal axes, one in each lane.
//
// The equations of ancf_body_step.h, with the residual along the mean vectors:
//   y = Ē⁻¹ Δw M + Δt S,  S the matrix of the mean stresses         (BATCH-1)
// S is symmetric to the bit, so that the moment of the residual, which is the
// antisymmetric part of y, has no rounding of the penalty's in it. The dual
// vectors of e₁ and K of (EM-6) are those of the first iteration. The last
// correction δw = E₁⁻ᵀ x is applied to increments by
//   Δe −= ½ Δt δw,  Δε −= ½ Δt sym(x)                               (BATCH-2)
// instead of evaluating them again.

#if defined(EMMY_INTEGRATE_ANCF_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_INTEGRATE_ANCF_BATCH_INL_H_
#undef EMMY_INTEGRATE_ANCF_BATCH_INL_H_
#else
#define EMMY_INTEGRATE_ANCF_BATCH_INL_H_
#endif

#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/lane_pack-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// Stretches and shears of (ANCF-4).
struct PackStrain {
  Pack3 normal;
  Pack3 shear;
};

struct AncfIncrement {
  Pack33 gradients;
  Pack33 rates;
  PackStrain strain;
};

class AncfPackStep {
 public:
  HWY_INLINE AncfPackStep(const BatchStep& step, int lane, AncfBlock* block)
      : step_(step),
        lane_(lane),
        block_(*block),
        moment_(Load3(block->moment, lane)) {}

  // Advances the lanes that are alive and converge; returns the others.
  HWY_INLINE Flag Advance() {
    const Flag alive =
        Broadcast(0.0) < Load(block_.centre.alive + lane_);
    AncfIncrement increment;
    const Flag done = Solve(alive, &increment);
    if (All(done)) {
      Commit(Writer<true>(done), increment);
    } else {
      Commit(Writer<false>(done), increment);
    }
    return Without(alive, done);
  }

 private:
  static constexpr int kMaxIterations = 12;

  // x of (EM-6); `antisymmetric` is that part of y.
  HWY_INLINE Pack33 TangentSolve(const Pack33& y,
                                 const Pack3& antisymmetric) const {
    const Pack3 normal = Load3(block_.normal_inverse, lane_);
    const Pack3 first = Load3(block_.shear_first, lane_);
    const Pack3 second = Load3(block_.shear_second, lane_);
    const Pack3 coupling = Load3(block_.shear_coupling, lane_);
    const Pack d0 = coupling.x * antisymmetric.x;
    const Pack d1 = coupling.y * antisymmetric.y;
    const Pack d2 = coupling.z * antisymmetric.z;
    return {{normal.x * y.a.x, first.x * y.a.y + d0, second.z * y.a.z - d2},
            {second.x * y.b.x - d0, normal.y * y.b.y, first.y * y.b.z + d1},
            {first.z * y.c.x + d2, second.y * y.c.y - d1, normal.z * y.c.z}};
  }

  static HWY_INLINE Pack3 Antisymmetric(const Pack33& y) {
    return {y.a.y - y.b.x, y.b.z - y.c.y, y.c.x - y.a.z};
  }

  HWY_INLINE Pack33 TimesMoments(const Pack33& x) const {
    return {moment_.x * x.a, moment_.y * x.b, moment_.z * x.c};
  }

  HWY_INLINE Flag Solve(Flag alive, AncfIncrement* result) {
    const Pack half = Broadcast(0.5);
    const Pack time_step = Broadcast(step_.time_step);
    const Pack half_step = Broadcast(0.5 * step_.time_step);
    const Pack roundoff = Broadcast(0x1p-53);
    const Pack size_of_step = Absolute(time_step);
    Pack33 change = time_step * Load33(block_.acceleration.next, lane_);
    Flag active = alive;
    Flag failed = Without(alive, alive);
    PackMonitor strain_monitor(0x1p-6);
    PackMonitor rotation_monitor(0x1p-10);
    Pack33 to_change;  // E₁⁻ᵀ
    Pack33 turn;       // K
    Pack strain_floor = Broadcast(0.0);
    Pack rotation_floor = strain_floor;
    Pack settled_below = strain_floor;
    Pack corrected = strain_floor;  // Since `to_change`.
    Pack previous = strain_floor;
    Pack iterations = Load(block_.centre.iterations + lane_);
    // What lanes that are not alive are given, and do not take.
    *result = {change, change, {change.a, change.a}};
    for (int i = 0; i < kMaxIterations; ++i) {
      iterations = iterations + OrZero(active, Broadcast(1.0));
      const Pack33 mean_rates =
          Load33(block_.rates.value, lane_) +
          (Load33(block_.rates.compensation, lane_) + half * change);
      const Pack33 turned = time_step * mean_rates;
      const Pack33 mean =
          Load33(block_.gradients.value, lane_) +
          (Load33(block_.gradients.compensation, lane_) + half * turned);
      const PackStrain strain = {
          {Dot(mean.a, turned.a), Dot(mean.b, turned.b), Dot(mean.c, turned.c)},
          {Dot(mean.a, turned.b) + Dot(mean.b, turned.a),
           Dot(mean.b, turned.c) + Dot(mean.c, turned.b),
           Dot(mean.c, turned.a) + Dot(mean.a, turned.c)}};
      const Pack3 normal = Impulse(strain.normal, 0);
      const Pack3 shear = Impulse(strain.shear, 3);
      const Pack33 dual = Dual(mean);
      Pack33 y = TimesMoments(TransposedTimes(dual, change));
      y.a = y.a + Pack3{normal.x, shear.x, shear.z};
      y.b = y.b + Pack3{shear.x, normal.y, shear.y};
      y.c = y.c + Pack3{shear.z, shear.y, normal.z};
      const Pack3 moment = Antisymmetric(y);
      if (i == 0) {
        const Pack33 end = mean + half * turned;
        to_change = Dual(end);
        turn = TransposedTimes(dual, to_change);
        const Pack one = Broadcast(1.0);
        turn.a.x = turn.a.x - one;
        turn.b.y = turn.b.y - one;
        turn.c.z = turn.c.z - one;
        const Pack rate_scale = MaxAbsolute(mean_rates);
        strain_floor = Broadcast(4.0) * roundoff * rate_scale;
        rotation_floor = roundoff * MaxAbsolute(change);
        settled_below = Broadcast(0x1p-61) * rate_scale;
      }
      const Pack33 guess = TangentSolve(y, moment);
      const Pack33 rest = y - TimesMoments(turn * guess);
      Pack33 x = TangentSolve(rest, Antisymmetric(rest));
      Pack33 correction = to_change * x;
      const Flag mass_only =
          Broadcast(0.0) < Load(block_.mass_dominates + lane_);
      if (!None(mass_only)) {
        const Pack3 inverse = Load3(block_.inverse_moment, lane_);
        const Pack33 force = mean * y;
        const Pack33 plain = {inverse.x * force.a, inverse.y * force.b,
                              inverse.z * force.c};
        correction = Choose(mass_only, plain, correction);
        x = Choose(mass_only, TransposedTimes(mean + half * turned, plain), x);
      }
      change = change - correction;

      const Pack size = MaxAbsolute(correction);
      const Flag strain_done =
          strain_monitor.Update(size, strain_floor, i > 0);
      const Flag rotation_done = rotation_monitor.Update(
          MaxAbsolute(moment) *
              Load(block_.inverse_smallest_moment_sum + lane_),
          rotation_floor, i > 0);
      corrected = corrected + size;
      const Flag settled = size_of_step * size * corrected <= settled_below;
      const Flag done = And(And(strain_done, rotation_done), settled);
      if (!None(And(active, done))) {
        result->rates = Choose(active, change, result->rates);
        result->gradients = Choose(active, turned - half_step * correction,
                                   result->gradients);
        const Pack3 shear_change = {x.a.y + x.b.x, x.b.z + x.c.y,
                                    x.c.x + x.a.z};
        result->strain.normal =
            Choose(active,
                   strain.normal - half_step * Pack3{x.a.x, x.b.y, x.c.z},
                   result->strain.normal);
        result->strain.shear =
            Choose(active, strain.shear - half_step * shear_change,
                   result->strain.shear);
      }
      Flag slow = Without(alive, alive);
      if (i > 0) {
        slow = And(Broadcast(1e3) * strain_floor < size,
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
    return Without(Without(alive, failed), active);
  }

  // Δt b ε̄ for three of the strains.
  HWY_INLINE Pack3 Impulse(const Pack3& increment, int first) const {
    const Pack3 mean =
        Load3(block_.strain.value + first, lane_) +
        (Load3(block_.strain.compensation + first, lane_) +
         Broadcast(0.5) * increment);
    const Pack3 impulse = Load3(block_.impulse + first, lane_);
    return {impulse.x * mean.x, impulse.y * mean.y, impulse.z * mean.z};
  }

  template <bool kAll>
  HWY_INLINE void Commit(const Writer<kAll>& writer,
                         const AncfIncrement& increment) {
    AdvanceCentre(step_, writer, lane_, &block_.centre);
    writer.Add33(increment.gradients, lane_, &block_.gradients);
    writer.Add33(increment.rates, lane_, &block_.rates);
    writer.Add3(increment.strain.normal, block_.strain.value,
                block_.strain.compensation, lane_);
    writer.Add3(increment.strain.shear, block_.strain.value + 3,
                block_.strain.compensation + 3, lane_);
    const Pack per_time = Broadcast(step_.inverse_time_step);
    const Pack3 acceleration[3] = {per_time * increment.rates.a,
                                   per_time * increment.rates.b,
                                   per_time * increment.rates.c};
    Predict(acceleration, writer, lane_, &block_.acceleration);
  }

  const BatchStep& step_;
  int lane_;
  AncfBlock& block_;
  Pack3 moment_;
};

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_ANCF_BATCH_INL_H_
