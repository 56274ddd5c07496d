// One step of several free conventional bodies in principal axes, one a lane.
//
// In principal axes (CRB-4), divided by Jᵢ, is
//   ΔWᵢ + aᵢ W̄ⱼ W̄ₖ = 0,  aᵢ = Δt (Jₖ − Jⱼ)/Jᵢ, i, j, k cyclic     (BATCH-4)
// and its Jacobian 1 + O with Oᵢⱼ = ½ aᵢ W̄ₖ, Oᵢₖ = ½ aᵢ W̄ⱼ, of the size ½
// |W|Δt. The residual is evaluated in pairs of doubles, aᵢ too, for what its
// rounding would leave has a mean of its own and adds up. From an extrapolated
// start one correction r − O r + O² r is then the step: what it leaves is
// bounded beforehand, by |O|³|r| + |a||r|²/4.

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

// Compensated sums of the components of vectors.
struct PackSum3 {
  PackSum x, y, z;
};

class ConventionalPackStep {
 public:
  static constexpr int kCorrections = 1;  // In a round.
  // Packs. A round is a chain of operations that wait for each other: that of
  // another pack fills the time.
  static constexpr int kTogether = 2;

  using Increment = PackSum3;  // ΔW

  static HWY_INLINE Pack3 Change(const Increment& increment) {
    return {increment.x.value, increment.y.value, increment.z.value};
  }

  HWY_INLINE ConventionalPackStep(const BatchStep& step, int lane,
                                  ConventionalBlock* block)
      : step_(step), lane_(lane), block_(*block) {}

  HWY_INLINE Pack3 Start() const {
    return Broadcast(step_.time_step) * Load3(block_.acceleration.next, lane_);
  }

  // One correction of ΔW, of the square `size`; returns the lanes in which what
  // is left is lost in rounding.
  HWY_INLINE Flag Round(const Pack3& start, Increment* increment,
                        Pack* size) const {
    const PackSum3 mean = Mean(start);
    const Pack3 residual = {Residual(start.x, 0, mean.y, mean.z),
                            Residual(start.y, 1, mean.z, mean.x),
                            Residual(start.z, 2, mean.x, mean.y)};
    const Pack3 half_mean =
        Broadcast(0.5) * Pack3{mean.x.value, mean.y.value, mean.z.value};
    const Pack3 correction =
        Less(residual, half_mean, Less(residual, half_mean, residual));
    *increment = {FastTwoDifference(start.x, correction.x),
                  FastTwoDifference(start.y, correction.y),
                  FastTwoDifference(start.z, correction.z)};
    const Pack3 high = Change(*increment);
    // Squares of norms, so that a sum of two has a factor of two: |O|³ of the
    // correction, and what is quadratic.
    const Pack square = Dot(correction, correction);
    const Pack high_square = Dot(high, high);
    const Pack coupling = Load(block_.coupling_square + lane_);
    const Pack contraction = coupling * Dot(half_mean, half_mean);
    const Pack left =
        MulAdd(contraction * contraction, contraction, coupling * square) *
        square;
    const Pack sum = square + high_square;
    *size = square;
    return And(left <= Broadcast(0x1p-126 / 2.0) * high_square,
               sum - sum <= Broadcast(0.0));
  }

  // The end of the step.
  template <bool kAll>
  HWY_INLINE void Commit(const Writer<kAll>& writer,
                         const Increment& increment) const {
    const Pack3 high = Change(increment);
    const Pack half = Broadcast(0.5);
    CompensatedLanes<3>& rate = block_.angular_velocity;
    // (ROT-5): ½ Θ = Δt ½ W̄.
    const Pack3 mean = Load3(rate.value, lane_) +
                       MulAdd(half, high, Load3(rate.compensation, lane_));
    const Pack3 half_turn = Broadcast(0.5 * step_.time_step) * mean;
    // What the next step begins with comes first.
    writer.Add(increment.x, rate.value[0] + lane_,
               rate.compensation[0] + lane_);
    writer.Add(increment.y, rate.value[1] + lane_,
               rate.compensation[1] + lane_);
    writer.Add(increment.z, rate.value[2] + lane_,
               rate.compensation[2] + lane_);
    const Pack3 acceleration[1] = {Broadcast(step_.inverse_time_step) * high};
    Predict(acceleration, writer, lane_, &block_.acceleration);
    AdvanceCentre(step_, writer, lane_, &block_.centre);
    const Pack scalar = InverseRootLessOne(Dot(half_turn, half_turn));
    const Pack3 v = MulAdd(scalar, half_turn, half_turn);
    CompensatedLanes<4>& q = block_.quaternion;
    const Pack w = Load(q.value[0] + lane_);
    const Pack3 u = Load3(q.value + 1, lane_);
    const Pack3 vector = MulAdd(w, v, MulAdd(scalar, u, Cross(u, v)));
    writer.Add(MulSub(w, scalar, Dot(u, v)), q.value[0] + lane_,
               q.compensation[0] + lane_);
    writer.Add3(vector, q.value + 1, q.compensation + 1, lane_);
  }

 private:
  // W̄
  HWY_INLINE PackSum3 Mean(const Pack3& change) const {
    const Pack3 low =
        MulAdd(Broadcast(0.5), change,
               Load3(block_.angular_velocity.compensation, lane_));
    const Pack3 high = Load3(block_.angular_velocity.value, lane_);
    return {FastTwoSum(high.x, low.x), FastTwoSum(high.y, low.y),
            FastTwoSum(high.z, low.z)};
  }

  // change + a b c for extended a, b and c.
  HWY_INLINE Pack Residual(Pack change, size_t i, const PackSum& b,
                           const PackSum& c) const {
    const Pack a = Load(block_.coupling[i] + lane_);
    const Pack a_low = Load(block_.coupling_low[i] + lane_);
    const PackSum product = TwoProduct(b.value, c.value);
    const Pack product_low =
        MulAdd(b.value, c.error, MulAdd(b.error, c.value, product.error));
    const PackSum term = TwoProduct(a, product.value);
    const Pack term_low =
        MulAdd(a, product_low, MulAdd(a_low, product.value, term.error));
    return (change + term.value) + term_low;
  }

  // v − O w, with u = ½ W̄.
  HWY_INLINE Pack3 Less(const Pack3& v, const Pack3& u, const Pack3& w) const {
    const Pack3 a = Load3(block_.coupling, lane_);
    return {NegMulAdd(a.x, MulAdd(u.z, w.y, u.y * w.z), v.x),
            NegMulAdd(a.y, MulAdd(u.x, w.z, u.z * w.x), v.y),
            NegMulAdd(a.z, MulAdd(u.y, w.x, u.x * w.y), v.z)};
  }

  // 1/√(1 + s) − 1, to a rounding of itself.
  static HWY_INLINE Pack InverseRootLessOne(Pack s) {
    // The binomial series to s⁵ is good to 2⁻⁵⁵ of itself below 2⁻¹¹.
    Pack series = MulAdd(Broadcast(-63.0 / 256.0), s, Broadcast(35.0 / 128.0));
    series = MulAdd(series, s, Broadcast(-5.0 / 16.0));
    series = MulAdd(series, s, Broadcast(3.0 / 8.0));
    series = MulAdd(series, s, Broadcast(-0.5)) * s;
    const Flag is_small = s < Broadcast(0x1p-11);
    if (All(is_small)) return series;
    const Pack one = Broadcast(1.0);
    const Pack n = SquareRoot(one + s);
    const Pack closed = (Broadcast(0.0) - s) / (n * (one + n));
    return Choose(is_small, series, closed);
  }

  const BatchStep& step_;
  int lane_;
  ConventionalBlock& block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_CONVENTIONAL_BATCH_INL_H_
