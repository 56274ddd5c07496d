// Several bodies' numbers in one vector register, with the operators of one.
//
// Compiled once for each instruction set; see batch_kernels.cc. Every operation
// acts on each lane by itself and rounds as IEEE 754 says, so that a lane has
// the same bits in a vector of any width. MulAdd rounds once where the
// instruction set has that operation, which is all from AVX2 on and Arm's; the
// older ones round the product too, and have bits of their own.

#if defined(EMMY_INTEGRATE_LANE_PACK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_INTEGRATE_LANE_PACK_INL_H_
#undef EMMY_INTEGRATE_LANE_PACK_INL_H_
#else
#define EMMY_INTEGRATE_LANE_PACK_INL_H_
#endif

#include <cstddef>

#include "emmy/integrate/batch_blocks.h"
#include "emmy/numerics/error_free_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using PackTag = hn::CappedTag<double, kBatchLanes>;
inline constexpr int kPackLanes = static_cast<int>(hn::MaxLanes(PackTag()));

struct Pack {
  static HWY_INLINE Pack Set(double x) { return {hn::Set(PackTag(), x)}; }

  hn::Vec<PackTag> v;
};
// A truth value in each lane.
struct Flag {
  hn::Mask<PackTag> m;
};

HWY_INLINE Pack Broadcast(double x) { return Pack::Set(x); }
HWY_INLINE Pack Load(const double* lanes) {
  return {hn::Load(PackTag(), lanes)};
}
HWY_INLINE void Store(Pack x, double* lanes) {
  hn::Store(x.v, PackTag(), lanes);
}

HWY_INLINE Pack operator+(Pack a, Pack b) { return {hn::Add(a.v, b.v)}; }
HWY_INLINE Pack operator-(Pack a, Pack b) { return {hn::Sub(a.v, b.v)}; }
HWY_INLINE Pack operator*(Pack a, Pack b) { return {hn::Mul(a.v, b.v)}; }
HWY_INLINE Pack operator/(Pack a, Pack b) { return {hn::Div(a.v, b.v)}; }
// a b + c, c − a b, a b − c.
HWY_INLINE Pack MulAdd(Pack a, Pack b, Pack c) {
  return {hn::MulAdd(a.v, b.v, c.v)};
}
HWY_INLINE Pack NegMulAdd(Pack a, Pack b, Pack c) {
  return {hn::NegMulAdd(a.v, b.v, c.v)};
}
HWY_INLINE Pack MulSub(Pack a, Pack b, Pack c) {
  return {hn::MulSub(a.v, b.v, c.v)};
}
HWY_INLINE Pack SquareRoot(Pack a) { return {hn::Sqrt(a.v)}; }
// Which of the two is returned if one is NaN depends on the instruction set.
HWY_INLINE Pack Smaller(Pack a, Pack b) { return {hn::Min(a.v, b.v)}; }

HWY_INLINE Flag operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE Flag operator<=(Pack a, Pack b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE Flag And(Flag a, Flag b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE Flag Or(Flag a, Flag b) { return {hn::Or(a.m, b.m)}; }
// a and not b.
HWY_INLINE Flag Without(Flag a, Flag b) { return {hn::AndNot(b.m, a.m)}; }
HWY_INLINE bool All(Flag a) { return hn::AllTrue(PackTag(), a.m); }
HWY_INLINE bool None(Flag a) { return hn::AllFalse(PackTag(), a.m); }
HWY_INLINE Pack Choose(Flag condition, Pack yes, Pack no) {
  return {hn::IfThenElse(condition.m, yes.v, no.v)};
}
HWY_INLINE Pack OrZero(Flag condition, Pack yes) {
  return {hn::IfThenElseZero(condition.m, yes.v)};
}

// A vector in each lane.
struct Pack3 {
  Pack x, y, z;
};
HWY_INLINE Pack3 operator+(const Pack3& a, const Pack3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Pack3 operator-(const Pack3& a, const Pack3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Pack3 operator*(Pack s, const Pack3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE Pack3 MulAdd(Pack s, const Pack3& a, const Pack3& b) {
  return {MulAdd(s, a.x, b.x), MulAdd(s, a.y, b.y), MulAdd(s, a.z, b.z)};
}
HWY_INLINE Pack3 NegMulAdd(Pack s, const Pack3& a, const Pack3& b) {
  return {NegMulAdd(s, a.x, b.x), NegMulAdd(s, a.y, b.y),
          NegMulAdd(s, a.z, b.z)};
}
HWY_INLINE Pack Dot(const Pack3& a, const Pack3& b) {
  return MulAdd(a.z, b.z, MulAdd(a.y, b.y, a.x * b.x));
}
// a·b + c
HWY_INLINE Pack Dot(const Pack3& a, const Pack3& b, Pack c) {
  return MulAdd(a.z, b.z, MulAdd(a.y, b.y, MulAdd(a.x, b.x, c)));
}
HWY_INLINE Pack3 Times(const Pack3& a, const Pack3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE Pack3 Cross(const Pack3& a, const Pack3& b) {
  return {MulSub(a.y, b.z, a.z * b.y), MulSub(a.z, b.x, a.x * b.z),
          MulSub(a.x, b.y, a.y * b.x)};
}
HWY_INLINE Pack3 Load3(const Lanes* entries, int lane) {
  return {Load(entries[0] + lane), Load(entries[1] + lane),
          Load(entries[2] + lane)};
}

// Columns a, b, c.
struct Pack33 {
  Pack3 a, b, c;
};
HWY_INLINE Pack33 operator+(const Pack33& m, const Pack33& n) {
  return {m.a + n.a, m.b + n.b, m.c + n.c};
}
HWY_INLINE Pack33 operator-(const Pack33& m, const Pack33& n) {
  return {m.a - n.a, m.b - n.b, m.c - n.c};
}
HWY_INLINE Pack33 MulAdd(Pack s, const Pack33& m, const Pack33& n) {
  return {MulAdd(s, m.a, n.a), MulAdd(s, m.b, n.b), MulAdd(s, m.c, n.c)};
}
HWY_INLINE Pack33 operator*(Pack s, const Pack33& m) {
  return {s * m.a, s * m.b, s * m.c};
}
HWY_INLINE Pack3 operator*(const Pack33& m, const Pack3& v) {
  return MulAdd(v.z, m.c, MulAdd(v.y, m.b, v.x * m.a));
}
HWY_INLINE Pack33 operator*(const Pack33& m, const Pack33& n) {
  return {m * n.a, m * n.b, m * n.c};
}
// mᵀ v
HWY_INLINE Pack3 TransposedTimes(const Pack33& m, const Pack3& v) {
  return {Dot(m.a, v), Dot(m.b, v), Dot(m.c, v)};
}
HWY_INLINE Pack33 TransposedTimes(const Pack33& m, const Pack33& n) {
  return {TransposedTimes(m, n.a), TransposedTimes(m, n.b),
          TransposedTimes(m, n.c)};
}
HWY_INLINE Pack33 Load33(const Lanes* entries, int lane) {
  return {Load3(entries, lane), Load3(entries + 3, lane),
          Load3(entries + 6, lane)};
}
// The vectors dual to the columns, m⁻ᵀ, times the determinant.
struct Cofactors {
  Pack33 vectors;
  Pack determinant;
};
HWY_INLINE Cofactors CofactorsOf(const Pack33& m) {
  const Pack3 bc = Cross(m.b, m.c);
  return {{bc, Cross(m.c, m.a), Cross(m.a, m.b)}, Dot(m.a, bc)};
}

using PackSum = WithError<Pack>;

// What the rounding of s m drops.
HWY_INLINE Pack3 ProductError(Pack s, const Pack3& v) {
  return {TwoProduct(s, v.x).error, TwoProduct(s, v.y).error,
          TwoProduct(s, v.z).error};
}
HWY_INLINE Pack33 ProductError(Pack s, const Pack33& m) {
  return {ProductError(s, m.a), ProductError(s, m.b), ProductError(s, m.c)};
}

// What a step writes: only lanes of `done`, or all of them.
template <bool kAll>
class Writer {
 public:
  explicit Writer(Flag done) : done_(done) {}

  HWY_INLINE void Write(Pack x, double* lanes) const {
    if constexpr (kAll) {
      Store(x, lanes);
    } else {
      Store(Choose(done_, x, Load(lanes)), lanes);
    }
  }

  // (SUM-2); the lanes' values and compensations are at these addresses. Where
  // a value is below its increment, near zero, what is lost is a rounding of
  // the increment, and so no more than that has already.
  HWY_INLINE void Add(Pack increment, double* value,
                      double* compensation) const {
    const PackSum result =
        FastTwoSum(Load(value), increment + Load(compensation));
    Write(result.value, value);
    Write(result.error, compensation);
  }

  // The same for an increment with a low-order part.
  HWY_INLINE void Add(const PackSum& increment, double* value,
                      double* compensation) const {
    const PackSum first = FastTwoSum(Load(value), increment.value);
    const PackSum second = FastTwoSum(
        first.value, first.error + (Load(compensation) + increment.error));
    Write(second.value, value);
    Write(second.error, compensation);
  }

  HWY_INLINE void Add3(const Pack3& increment, Lanes* value,
                       Lanes* compensation, int lane) const {
    Add(increment.x, value[0] + lane, compensation[0] + lane);
    Add(increment.y, value[1] + lane, compensation[1] + lane);
    Add(increment.z, value[2] + lane, compensation[2] + lane);
  }

  // The same for increments with low-order parts.
  HWY_INLINE void Add3(const Pack3& increment, const Pack3& low, Lanes* value,
                       Lanes* compensation, int lane) const {
    Add(PackSum{increment.x, low.x}, value[0] + lane, compensation[0] + lane);
    Add(PackSum{increment.y, low.y}, value[1] + lane, compensation[1] + lane);
    Add(PackSum{increment.z, low.z}, value[2] + lane, compensation[2] + lane);
  }
  HWY_INLINE void Add33(const Pack33& increment, const Pack33& low, int lane,
                        CompensatedLanes<9>* to) const {
    Add3(increment.a, low.a, to->value, to->compensation, lane);
    Add3(increment.b, low.b, to->value + 3, to->compensation + 3, lane);
    Add3(increment.c, low.c, to->value + 6, to->compensation + 6, lane);
  }

  HWY_INLINE void Add33(const Pack33& increment, int lane,
                        CompensatedLanes<9>* to) const {
    Add3(increment.a, to->value, to->compensation, lane);
    Add3(increment.b, to->value + 3, to->compensation + 3, lane);
    Add3(increment.c, to->value + 6, to->compensation + 6, lane);
  }

 private:
  Flag done_;
};

// Δt v̄ of a constant velocity, the same in every step.
HWY_INLINE void PrepareCentre(const BatchStep& step, int lane,
                              CentreLanes* centre) {
  for (size_t i = 0; i < 3; ++i) {
    const Pack mean = Load(centre->velocity.value[i] + lane) +
                      Load(centre->velocity.compensation[i] + lane);
    const PackSum motion = TwoProduct(Broadcast(step.time_step), mean);
    Store(motion.value, centre->motion[i] + lane);
    Store(motion.error, centre->motion_error[i] + lane);
  }
}

// The centre of mass under constant gravity, in closed form.
template <bool kAll>
HWY_INLINE void AdvanceCentre(const BatchStep& step, const Writer<kAll>& writer,
                              int lane, CentreLanes* centre) {
#pragma GCC unroll 3
  for (size_t i = 0; i < 3; ++i) {
    PackSum motion = {Load(centre->motion[i] + lane),
                      Load(centre->motion_error[i] + lane)};
    if (step.has_gravity) {
      double* const v = centre->velocity.value[i] + lane;
      double* const vc = centre->velocity.compensation[i] + lane;
      const Pack change = Broadcast(step.velocity_increment[i]);
      motion = TwoProduct(Broadcast(step.time_step),
                          Load(v) + MulAdd(Broadcast(0.5), change, Load(vc)));
      writer.Add(change, v, vc);
    }
    double* const x = centre->position.value[i] + lane;
    double* const xc = centre->position.compensation[i] + lane;
    const PackSum first = TwoSum(Load(x), motion.value);
    const PackSum second =
        FastTwoSum(first.value, first.error + (Load(xc) + motion.error));
    writer.Write(second.value, x);
    writer.Write(second.error, xc);
  }
}

HWY_INLINE Flag Alive(const CentreLanes& centre, int lane) {
  return Broadcast(0.0) < Load(centre.alive + lane);
}

// Corrects the lanes that are alive until each has converged or its corrections
// no longer halve; returns the lanes that have not. A round of
// Step::kCorrections corrections ends the step in those of the active lanes
// that have converged: they are left alone while others go on. `one_round`
// becomes whether the first ended it in all lanes. A Step has Start, where to
// begin; Round, which gives an increment, the square of its last correction and
// the lanes where it is the last; Change, of the rates; and Commit.
//
// Not inlined: a loop's constants are kept in registers, which a step of one
// round needs for itself.
template <typename Step>
HWY_NOINLINE Flag Iterate(const Step& step, int lane, CentreLanes* centre,
                          bool* one_round) {
  constexpr int kMaxCorrections = 8;
  const Pack corrections = Broadcast(Step::kCorrections);
  *one_round = false;
  Flag active = Alive(*centre, lane);
  if (None(active)) return active;
  auto change = step.Start();
  Flag failed = Without(active, active);
  Pack previous = Broadcast(0.0);
  Pack iterations = Load(centre->iterations + lane);
  for (int i = 0; i < kMaxCorrections; i += Step::kCorrections) {
    typename Step::Increment increment;
    Pack size;
    const Flag done = And(active, step.Round(change, &increment, &size));
    iterations = iterations + OrZero(active, corrections);
    if (i == 0) *one_round = All(done);
    if (!None(done)) step.Commit(Writer<false>(done), increment);
    active = Without(active, done);
    if (None(active)) break;
    if (i > 0) {
      const Flag slow = And(active, Broadcast(0.25) * previous < size);
      failed = Or(failed, slow);
      active = Without(active, slow);
      if (None(active)) break;
    }
    change = Step::Change(increment);
    previous = size;
  }
  Store(iterations, centre->iterations + lane);
  return Or(failed, active);
}

// Takes the accelerations of this step and predicts the next (EXTRA-1), to an
// order below the number of differences kept.
template <bool kAll, size_t kVectors, size_t kDifferences>
HWY_INLINE void Predict(const Pack3 (&acceleration)[kVectors],
                        const Writer<kAll>& writer, int lane,
                        ExtrapolationLanes<3 * kVectors, kDifferences>* kept) {
  static_assert(kDifferences >= 2);
  Pack errors[kDifferences];  // Sums of squares, by order.
  for (Pack& error : errors) error = Broadcast(0.0);
#pragma GCC unroll 9
  for (size_t i = 0; i < 3 * kVectors; ++i) {
    const Pack3& vector = acceleration[i / 3];
    Pack difference = i % 3 == 0 ? vector.x : i % 3 == 1 ? vector.y : vector.z;
#pragma GCC unroll 4
    for (size_t j = 0; j < kDifferences; ++j) {
      double* const kept_here = kept->difference[j][i] + lane;
      const Pack next_difference = difference - Load(kept_here);
      writer.Write(difference, kept_here);
      errors[j] = MulAdd(next_difference, next_difference, errors[j]);
      difference = next_difference;
    }
  }
  // Whether the best order is this or above.
  Flag used[kDifferences];
  Pack best = errors[0];
#pragma GCC unroll 4
  for (size_t j = 1; j < kDifferences; ++j) {
    used[j] = errors[j] < best;
    best = Smaller(best, errors[j]);
  }
#pragma GCC unroll 4
  for (size_t j = kDifferences - 2; j >= 1; --j) {
    used[j] = Or(used[j], used[j + 1]);
  }
  Pack use[kDifferences];
#pragma GCC unroll 4
  for (size_t j = 1; j < kDifferences; ++j) {
    use[j] = OrZero(used[j], Broadcast(1.0));
  }
#pragma GCC unroll 9
  for (size_t i = 0; i < 3 * kVectors; ++i) {
    Pack next = Load(kept->difference[0][i] + lane);
#pragma GCC unroll 4
    for (size_t j = kDifferences - 1; j >= 1; --j) {
      next = MulAdd(use[j], Load(kept->difference[j][i] + lane), next);
    }
    writer.Write(next, kept->next[i] + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_LANE_PACK_INL_H_
