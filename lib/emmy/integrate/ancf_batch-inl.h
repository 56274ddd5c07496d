// One step of several free ANCF bodies in principal axes, one in each lane.
//
// The equations of ancf_body_step.h, with the residual along the mean vectors:
//   y = Ē⁻¹ Δw M + Δt S,  S the matrix of the mean stresses         (BATCH-1)
// S is symmetric to the bit, so that the moment of the residual, which is the
// antisymmetric part of the first term, has no rounding of the penalty's in it.
// Along the same vectors, with a correction δw = Ē z, the Jacobian is exactly
//   z M + ¼ Δt z S + c ∘ sym(x),  x = E₁ᵀ Ē z = z + Nᵀ z            (BATCH-2)
// up to what is quadratic in δw, with c of (EM-6) and sym(x) the normal entries
// and the sums of the shear ones. Without S and N it is that of (EM-6), whose
// inverse is in closed form; they are of the size of the strain and of ½ |ω|Δt,
// and enter by successive corrections. A step is a thorough correction and a
// last one, or several such pairs. After the last, which goes into the
// increments by
//   Δe −= ½ Δt δw,  Δε −= ½ Δt sym(x)                               (BATCH-3)
// (Δe as a pair of doubles) instead of evaluating them again, what is left has
// to be lost in rounding, by bounds from quantities at hand instead of a ratio
// of corrections: as strain, and, a thousand times less, as moment
// (ancf_body_step.cc).

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

// Stretches and shears of (ANCF-4), or what belongs to them.
struct PackStrain {
  Pack3 normal;
  Pack3 shear;
};

// What a step adds to the bodies of a pack, but for their centres.
struct AncfIncrement {
  Pack33 gradients;
  Pack33 gradients_low;
  Pack33 rates;
  PackStrain strain;
};

class AncfPackStep {
 public:
  static constexpr int kCorrections = 2;  // In a round.
  static constexpr int kTogether = 1;     // Packs: one fills all registers.

  using Increment = AncfIncrement;

  static HWY_INLINE const Pack33& Change(const Increment& increment) {
    return increment.rates;
  }

  HWY_INLINE AncfPackStep(const BatchStep& step, int lane, AncfBlock* block)
      : step_(step), lane_(lane), block_(*block) {}

  HWY_INLINE Pack33 Start() const {
    return Broadcast(step_.time_step) * Load33(block_.acceleration.next, lane_);
  }

  // Two corrections of Δw, the last of the square `size`; returns the lanes in
  // which what is left is lost in rounding.
  HWY_INLINE Flag Round(const Pack33& start, Increment* increment,
                        Pack* size) const {
    return Finish(Correct(start), increment, size);
  }

  // The end of the step.
  template <bool kAll>
  HWY_INLINE void Commit(const Writer<kAll>& writer,
                         const Increment& increment) const {
    AdvanceCentre(step_, writer, lane_, &block_.centre);
    writer.Add33(increment.gradients, increment.gradients_low, lane_,
                 &block_.gradients);
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

 private:
  // The inverse of (EM-6); `antisymmetric` is that part of y.
  HWY_INLINE Pack33 TangentSolve(const Pack33& y,
                                 const Pack3& antisymmetric) const {
    const Pack3 normal = Load3(block_.normal_inverse, lane_);
    const Pack3 first = Load3(block_.shear_first, lane_);
    const Pack3 second = Load3(block_.shear_second, lane_);
    const Pack3 coupling = Load3(block_.shear_coupling, lane_);
    const Pack d0 = coupling.x * antisymmetric.x;
    const Pack d1 = coupling.y * antisymmetric.y;
    const Pack d2 = coupling.z * antisymmetric.z;
    return {{normal.x * y.a.x, MulAdd(first.x, y.a.y, d0),
             MulSub(second.z, y.a.z, d2)},
            {MulSub(second.x, y.b.x, d0), normal.y * y.b.y,
             MulAdd(first.y, y.b.z, d1)},
            {MulAdd(first.z, y.c.x, d2), MulSub(second.y, y.c.y, d1),
             normal.z * y.c.z}};
  }

  // The same for c ∘ q, which is symmetric.
  HWY_INLINE Pack33 TangentSolve(const PackStrain& q) const {
    const Pack3 normal = Times(Load3(block_.normal_share, lane_), q.normal);
    const Pack3 first = Times(Load3(block_.first_share, lane_), q.shear);
    const Pack3 second = Times(Load3(block_.second_share, lane_), q.shear);
    return {{normal.x, first.x, second.z},
            {second.x, normal.y, first.y},
            {first.z, second.y, normal.z}};
  }

  static HWY_INLINE Pack3 Antisymmetric(const Pack33& y) {
    return {y.a.y - y.b.x, y.b.z - y.c.y, y.c.x - y.a.z};
  }

  // sym(nᵀ z)
  static HWY_INLINE PackStrain Symmetric(const Pack33& n, const Pack33& z) {
    return {{Dot(n.a, z.a), Dot(n.b, z.b), Dot(n.c, z.c)},
            {Dot(n.b, z.a, Dot(n.a, z.b)), Dot(n.c, z.b, Dot(n.b, z.c)),
             Dot(n.a, z.c, Dot(n.c, z.a))}};
  }

  // z T for the symmetric matrix T.
  static HWY_INLINE Pack33 TimesStress(const Pack33& z, const PackStrain& t) {
    return {MulAdd(t.shear.z, z.c, MulAdd(t.shear.x, z.b, t.normal.x * z.a)),
            MulAdd(t.shear.y, z.c, MulAdd(t.normal.y, z.b, t.shear.x * z.a)),
            MulAdd(t.normal.z, z.c, MulAdd(t.shear.y, z.b, t.shear.z * z.a))};
  }
  // The antisymmetric part of z T.
  static HWY_INLINE Pack3 StressMoment(const Pack33& z, const PackStrain& t) {
    const auto entry = [](Pack a, Pack b, Pack c, Pack ta, Pack tb, Pack tc,
                          Pack from) {
      return MulAdd(tc, c, MulAdd(tb, b, MulAdd(ta, a, from)));
    };
    const auto less = [](Pack a, Pack b, Pack c, Pack ta, Pack tb, Pack tc,
                         Pack from) {
      return NegMulAdd(tc, c, NegMulAdd(tb, b, NegMulAdd(ta, a, from)));
    };
    const Pack zero = Broadcast(0.0);
    const Pack3& n = t.normal;
    const Pack3& s = t.shear;
    return {less(z.a.x, z.b.x, z.c.x, s.x, n.y, s.y,
                 entry(z.a.y, z.b.y, z.c.y, n.x, s.x, s.z, zero)),
            less(z.a.y, z.b.y, z.c.y, s.z, s.y, n.z,
                 entry(z.a.z, z.b.z, z.c.z, s.x, n.y, s.y, zero)),
            less(z.a.z, z.b.z, z.c.z, n.x, s.x, s.z,
                 entry(z.a.x, z.b.x, z.c.x, s.z, s.y, n.z, zero))};
  }

  // N = Ēᵀ E₁ − 1 for D = Ēᵀ Δe, as Ēᵀ Ē = 1 + 2 ε̄ − ¼ Δeᵀ Δe. The last term
  // is taken from the rotation in D, which is wrong by its square, or by the
  // strain, of itself.
  static HWY_INLINE Pack33 FrameChange(const Pack33& d,
                                       const PackStrain& mean) {
    const Pack half = Broadcast(0.5);
    const Pack two = Broadcast(2.0);
    const Pack3 u = half * Pack3{d.b.z, d.c.x, d.a.y};
    const Pack3 square = Times(u, u);
    const Pack xy = MulAdd(u.x, u.y, mean.shear.x);
    const Pack yz = MulAdd(u.y, u.z, mean.shear.y);
    const Pack zx = MulAdd(u.z, u.x, mean.shear.z);
    return {
        {MulAdd(half, d.a.x, MulSub(two, mean.normal.x, square.y + square.z)),
         MulAdd(half, d.a.y, xy), MulAdd(half, d.a.z, zx)},
        {MulAdd(half, d.b.x, xy),
         MulAdd(half, d.b.y, MulSub(two, mean.normal.y, square.z + square.x)),
         MulAdd(half, d.b.z, yz)},
        {MulAdd(half, d.c.x, zx), MulAdd(half, d.c.y, yz),
         MulAdd(half, d.c.z, MulSub(two, mean.normal.z, square.x + square.y))}};
  }

  // What a correction of Δw is made from.
  struct Evaluation {
    Pack33 mean_rates;
    Pack33 turned;      // Δe
    Pack33 mean;        // Ē
    Pack33 d;           // Ēᵀ Δe
    PackStrain strain;  // Δε
    PackStrain mean_strain;
    PackStrain stress;  // Δt times.
    Pack33 z;           // The solution of (EM-6).
  };

  HWY_INLINE Evaluation Evaluate(const Pack33& change) const {
    const Pack half = Broadcast(0.5);
    Evaluation e;
    e.mean_rates =
        Load33(block_.rates.value, lane_) +
        MulAdd(half, change, Load33(block_.rates.compensation, lane_));
    e.turned = Broadcast(step_.time_step) * e.mean_rates;
    e.mean =
        Load33(block_.gradients.value, lane_) +
        MulAdd(half, e.turned, Load33(block_.gradients.compensation, lane_));
    e.d = TransposedTimes(e.mean, e.turned);
    e.strain = {{e.d.a.x, e.d.b.y, e.d.c.z},
                {e.d.b.x + e.d.a.y, e.d.c.y + e.d.b.z, e.d.a.z + e.d.c.x}};
    e.mean_strain = {MeanStrain(e.strain.normal, 0),
                     MeanStrain(e.strain.shear, 3)};
    e.stress = {Times(Load3(block_.impulse, lane_), e.mean_strain.normal),
                Times(Load3(block_.impulse + 3, lane_), e.mean_strain.shear)};
    // The determinant's inverse is not waited for.
    const Cofactors cofactors = CofactorsOf(e.mean);
    const Pack33 inertial =
        TimesMoments(Broadcast(1.0) / cofactors.determinant,
                     TransposedTimes(cofactors.vectors, change));
    const Pack3& n = e.stress.normal;
    const Pack3& s = e.stress.shear;
    const Pack33 y = {inertial.a + Pack3{n.x, s.x, s.z},
                      inertial.b + Pack3{s.x, n.y, s.y},
                      inertial.c + Pack3{s.z, s.y, n.z}};
    e.z = TangentSolve(y, Antisymmetric(inertial));
    return e;
  }

  // A correction of Δw that leaves (½ |ω|Δt)³ and the strain times ½ |ω|Δt of
  // itself, and what is quadratic.
  HWY_INLINE Pack33 Correct(const Pack33& change) const {
    const Evaluation e = Evaluate(change);
    const Pack33 n = FrameChange(e.d, e.mean_strain);
    const Pack quarter_step = Broadcast(0.25 * step_.time_step);
    const PackStrain geometric = {quarter_step * e.stress.normal,
                                  quarter_step * e.stress.shear};
    const Pack33 rest = TimesStress(e.z, geometric);
    const Pack33 d1 = TangentSolve(Symmetric(n, e.z)) +
                      TangentSolve(rest, Antisymmetric(rest));
    const Pack33 d2 = TangentSolve(Symmetric(n, d1));
    return change - e.mean * ((e.z - d1) + d2);
  }

  // A correction that leaves ½ |ω|Δt of itself as strain, but none of the
  // moment; as Round.
  HWY_INLINE Flag Finish(const Pack33& start, Increment* increment,
                         Pack* size) const {
    const Pack half_step = Broadcast(0.5 * step_.time_step);
    const Pack quarter_step = Broadcast(0.25 * step_.time_step);
    const Evaluation e = Evaluate(start);
    const Pack3 moment = quarter_step * StressMoment(e.z, e.stress);
    const Pack3 first = Load3(block_.first_moment, lane_);
    const Pack3 second = Load3(block_.second_moment, lane_);
    Pack33 z = e.z;
    z.a.y = NegMulAdd(first.x, moment.x, z.a.y);
    z.b.x = MulAdd(second.x, moment.x, z.b.x);
    z.b.z = NegMulAdd(first.y, moment.y, z.b.z);
    z.c.y = MulAdd(second.y, moment.y, z.c.y);
    z.c.x = NegMulAdd(first.z, moment.z, z.c.x);
    z.a.z = MulAdd(second.z, moment.z, z.a.z);
    const Pack33 change = start - e.mean * z;

    // Squares of norms, so that a sum of three has a factor of three.
    const Pack3 turn = {e.d.b.z, e.d.c.x, e.d.a.y};
    const Pack z_square = SquareSum(z);
    const Pack strain_square = SquareSum(e.mean_strain);
    const Pack n_square =
        MulAdd(Broadcast(0.5), Dot(turn, turn), Broadcast(8.0) * strain_square);
    const Pack contraction = Load(block_.share_square + lane_) * n_square;
    const Pack stiffening =
        Load(block_.stiffening_square + lane_) * strain_square;
    const Pack quadratic = Load(block_.second_order_square + lane_) * z_square;
    const Pack change_square = SquareSum(change);
    const Pack strain_left = (contraction + stiffening) * z_square;
    const Pack turn_left =
        MulAdd(stiffening, contraction + stiffening, quadratic) * z_square;
    const Pack strain_limit =
        Broadcast(0x1p-114 / 2.0) * SquareSum(e.mean_rates);
    const Pack turn_limit = Broadcast(0x1p-126 / 3.0) * change_square;
    const Pack sum = z_square + change_square;
    const Pack3 normal = {z.a.x, z.b.y, z.c.z};
    const Pack3 shear = {z.a.y + z.b.x, z.b.z + z.c.y, z.c.x + z.a.z};
    *increment = {e.turned,
                  TurnedLow(e, change),
                  change,
                  {NegMulAdd(half_step, normal, e.strain.normal),
                   NegMulAdd(half_step, shear, e.strain.shear)}};
    *size = z_square;
    return And(And(strain_left <= strain_limit, turn_left <= turn_limit),
               sum - sum <= Broadcast(0.0));
  }

  // What Δt w̄ has besides e.turned, for the rate increment `change` instead of
  // the `start` of the last correction, see docs/theory.md: to the last bit,
  // but for a rounding of ½ Δw where that is larger than the rate itself.
  HWY_INLINE Pack33 TurnedLow(const Evaluation& e, const Pack33& change) const {
    const Pack step = Broadcast(step_.time_step);
    const Pack33 small = MulAdd(Broadcast(0.5), change,
                                Load33(block_.rates.compensation, lane_));
    const Pack33 rounding =
        small - (e.mean_rates - Load33(block_.rates.value, lane_));
    return MulAdd(step, rounding, ProductError(step, e.mean_rates));
  }

  // s x M
  HWY_INLINE Pack33 TimesMoments(Pack s, const Pack33& x) const {
    return {(s * Load(block_.moment[0] + lane_)) * x.a,
            (s * Load(block_.moment[1] + lane_)) * x.b,
            (s * Load(block_.moment[2] + lane_)) * x.c};
  }

  static HWY_INLINE Pack SquareSum(const Pack33& m) {
    return Dot(m.a, m.a, Dot(m.b, m.b, Dot(m.c, m.c)));
  }
  // Of the matrix.
  static HWY_INLINE Pack SquareSum(const PackStrain& s) {
    return MulAdd(Broadcast(2.0), Dot(s.shear, s.shear),
                  Dot(s.normal, s.normal));
  }

  // ε̄, three of the strains.
  HWY_INLINE Pack3 MeanStrain(const Pack3& increment, int first) const {
    return Load3(block_.strain.value + first, lane_) +
           MulAdd(Broadcast(0.5), increment,
                  Load3(block_.strain.compensation + first, lane_));
  }

  const BatchStep& step_;
  int lane_;
  AncfBlock& block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_ANCF_BATCH_INL_H_
