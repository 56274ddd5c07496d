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
    const Flag alive = Broadcast(0.0) < Load(block_.centre.alive + lane_);
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

  // x M + x T, with T = ¼ Δt S, for columns x of the two terms.
  HWY_INLINE Pack33 TimesStress(const Pack33& x, const Pack3& normal,
                                const Pack3& shear) const {
    return {(normal.x * x.a + shear.x * x.b) + shear.z * x.c,
            (shear.x * x.a + normal.y * x.b) + shear.y * x.c,
            (shear.z * x.a + shear.y * x.b) + normal.z * x.c};
  }

  // E₁⁻ᵀ and K for end vectors e₁ and the dual vectors of the mean ones.
  static HWY_INLINE void SetFrames(const Pack33& end, const Pack33& dual,
                                   Pack33* to_change, Pack33* turn) {
    const Pack one = Broadcast(1.0);
    *to_change = Dual(end);
    *turn = TransposedTimes(dual, *to_change);
    turn->a.x = turn->a.x - one;
    turn->b.y = turn->b.y - one;
    turn->c.z = turn->c.z - one;
  }

  HWY_INLINE Flag Solve(Flag alive, AncfIncrement* result) {
    const Pack half = Broadcast(0.5);
    const Pack time_step = Broadcast(step_.time_step);
    const Pack half_step = Broadcast(0.5 * step_.time_step);
    const Flag none = Without(alive, alive);
    Pack33 change = time_step * Load33(block_.acceleration.next, lane_);
    Flag active = alive;
    Flag failed = none;
    PackMonitor strain_monitor(0x1p-6);
    PackMonitor rotation_monitor(0x1p-10);
    Pack33 to_change = change;  // E₁⁻ᵀ
    Pack33 turn = change;       // K
    Pack previous = Broadcast(0.0);
    Pack corrected = previous;  // Sum of sizes since the frames were made.
    Flag stale = alive;
    Pack iterations = Load(block_.centre.iterations + lane_);
    const Flag mass_only = Broadcast(0.0) < Load(block_.mass_dominates + lane_);
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
        SetFrames(mean + half * turned, dual, &to_change, &turn);
      } else if (!None(stale)) {
        Pack33 new_to_change;
        Pack33 new_turn;
        SetFrames(mean + half * turned, dual, &new_to_change, &new_turn);
        to_change = Choose(stale, new_to_change, to_change);
        turn = Choose(stale, new_turn, turn);
        corrected = corrected - OrZero(stale, corrected);
      }
      const Pack33 x0 = TangentSolve(y, moment);
      const Pack33 rest1 = TimesMoments(turn * x0);
      const Pack33 x1 = x0 - TangentSolve(rest1, Antisymmetric(rest1));
      const Pack quarter_step = half * half_step;
      const Pack33 rest2 =
          TimesMoments(turn * x1) +
          TimesStress(x1, quarter_step * normal, quarter_step * shear);
      Pack33 x = x0 - TangentSolve(rest2, Antisymmetric(rest2));
      Pack33 correction = to_change * x;
      const Pack solved = MaxAbsolute(x - x1);
      const Pack solved_before = MaxAbsolute(x1 - x0);
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
      const Pack strain_floor = Broadcast(0x1p-51) * MaxAbsolute(mean_rates);
      const Pack rotation_floor = Broadcast(0x1p-53) * MaxAbsolute(change);
      const Pack negligible = Smaller(Broadcast(0x1p-11) * rotation_floor,
                                      Broadcast(0x1p-7) * strain_floor);
      corrected = corrected + size;
      const Pack change_of_frames =
          Load(block_.second_order + lane_) * corrected;
      const Flag solved_well =
          And(solved * (solved_before + solved) <= size * negligible,
              change_of_frames * size <= negligible);
      const Flag strain_done = strain_monitor.Update(size, strain_floor);
      const Flag rotation_done = rotation_monitor.Update(
          MaxAbsolute(moment) *
              Load(block_.inverse_smallest_moment_sum + lane_),
          rotation_floor);
      Flag done =
          Or(Without(solved_well, mass_only), And(strain_done, rotation_done));
      if (!None(And(active, done))) {
        done = And(done, IsFinite((change.a + change.b) + change.c));
        result->rates = Choose(active, change, result->rates);
        result->gradients =
            Choose(active, turned - half_step * correction, result->gradients);
        const Pack3 shear_change = {x.a.y + x.b.x, x.b.z + x.c.y,
                                    x.c.x + x.a.z};
        result->strain.normal = Choose(
            active, strain.normal - half_step * Pack3{x.a.x, x.b.y, x.c.z},
            result->strain.normal);
        result->strain.shear =
            Choose(active, strain.shear - half_step * shear_change,
                   result->strain.shear);
      }
      active = Without(active, done);
      if (None(active)) break;
      stale = And(active, Broadcast(0x1p-20) < change_of_frames);
      if (i > 0) {
        const Flag slow = And(active, And(Broadcast(1e3) * strain_floor < size,
                                          Broadcast(0.3) * previous < size));
        failed = Or(failed, slow);
        active = Without(active, slow);
        if (None(active)) break;
      }
      previous = size;
    }
    Store(iterations, block_.centre.iterations + lane_);
    return Without(Without(alive, failed), active);
  }

  // Δt b ε̄ for three of the strains.
  HWY_INLINE Pack3 Impulse(const Pack3& increment, int first) const {
    const Pack3 mean = Load3(block_.strain.value + first, lane_) +
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
