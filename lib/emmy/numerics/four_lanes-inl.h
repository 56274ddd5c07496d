// Four doubles side by side, for code that is compiled once for each
// instruction set (Highway's foreach_target.h): one vector where it has 256
// bits or more, else two of two, or plain numbers.
//
// The first lane stands apart: Next and Previous turn the last three,
//   Next (a, 1, 2, 3) = (a, 2, 3, 1),  Previous (a, 1, 2, 3) = (a, 3, 1, 2),
// so that a sum over the cyclic pairs of three vectors is one of lanes.
// Broadcast<i> puts lane i into all, SwapInPairs gives (1, 0, 3, 2), SwapPairs
// (2, 3, 0, 1). WithoutFirst puts zero into the first lane, SelectFirst takes
// that lane from its first argument, SelectLast the last from its second,
// FromSecond gives (1, 2, 3, 0) and FromLast (3, 0, 1, 2), LoadInterleaved
// reads x₀ y₀ z₀ x₁ … z₃. LoadPairs and StorePairs take two numbers at a time,
// StoreLastPair the last two alone: what two vectors have written cannot be
// read as one before both are in the cache.
//
// No operation is fused with another: the bits are those of plain arithmetic.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_FOUR_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_FOUR_LANES_INL_H_
#undef EMMY_NUMERICS_FOUR_LANES_INL_H_
#else
#define EMMY_NUMERICS_FOUR_LANES_INL_H_
#endif

#include <cmath>
#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

struct Lanes {
  double v[4];

  static Lanes Set(double x) { return {{x, x, x, x}}; }
  static Lanes First(double x) { return {{x, 0.0, 0.0, 0.0}}; }
  static Lanes Signs(double a, double b, double c, double d) {
    return {{a, b, c, d}};
  }
  static Lanes Load(const double* p) { return {{p[0], p[1], p[2], p[3]}}; }
  void Store(double* p) const {
    for (int i = 0; i < 4; ++i) p[i] = v[i];
  }
  static Lanes LoadPairs(const double* p) { return Load(p); }
  void StorePairs(double* p) const { Store(p); }
  void StoreLastPair(double* p) const {
    p[0] = v[2];
    p[1] = v[3];
  }
};

template <typename Operation>
Lanes Each(const Lanes& a, const Lanes& b, Operation operation) {
  Lanes result;
  for (int i = 0; i < 4; ++i) result.v[i] = operation(a.v[i], b.v[i]);
  return result;
}

inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return Each(a, b, [](double x, double y) { return x + y; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return Each(a, b, [](double x, double y) { return x - y; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return Each(a, b, [](double x, double y) { return x * y; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return Each(a, b, [](double x, double y) { return x / y; });
}
inline Lanes Max(const Lanes& a, const Lanes& b) {
  return Each(a, b, [](double x, double y) { return x > y ? x : y; });
}
inline Lanes Abs(const Lanes& a) {
  return Each(a, a, [](double x, double) { return std::abs(x); });
}
inline Lanes Next(const Lanes& a) { return {{a.v[0], a.v[2], a.v[3], a.v[1]}}; }
inline Lanes Previous(const Lanes& a) {
  return {{a.v[0], a.v[3], a.v[1], a.v[2]}};
}
template <int i>
inline Lanes Broadcast(const Lanes& a) {
  return Lanes::Set(a.v[i]);
}
inline Lanes SwapInPairs(const Lanes& a) {
  return {{a.v[1], a.v[0], a.v[3], a.v[2]}};
}
inline Lanes SwapPairs(const Lanes& a) {
  return {{a.v[2], a.v[3], a.v[0], a.v[1]}};
}
inline Lanes WithoutFirst(const Lanes& a) {
  return {{0.0, a.v[1], a.v[2], a.v[3]}};
}
inline Lanes SelectFirst(const Lanes& first, const Lanes& others) {
  return {{first.v[0], others.v[1], others.v[2], others.v[3]}};
}
inline Lanes SelectLast(const Lanes& others, const Lanes& last) {
  return {{others.v[0], others.v[1], others.v[2], last.v[3]}};
}
inline Lanes FromSecond(const Lanes& a) {
  return {{a.v[1], a.v[2], a.v[3], a.v[0]}};
}
inline Lanes FromLast(const Lanes& a) {
  return {{a.v[3], a.v[0], a.v[1], a.v[2]}};
}
inline void LoadInterleaved(const double* p, Lanes* x, Lanes* y, Lanes* z) {
  for (int i = 0; i < 4; ++i) {
    x->v[i] = p[3 * i];
    y->v[i] = p[3 * i + 1];
    z->v[i] = p[3 * i + 2];
  }
}
inline void StoreInterleaved(const Lanes& x, const Lanes& y, const Lanes& z,
                             double* p) {
  for (int i = 0; i < 4; ++i) {
    p[3 * i] = x.v[i];
    p[3 * i + 1] = y.v[i];
    p[3 * i + 2] = z.v[i];
  }
}

#elif HWY_MAX_BYTES >= 32

namespace hn = hwy::HWY_NAMESPACE;
using FourTag = hn::FixedTag<double, 4>;
using PairTag = hn::Half<FourTag>;

struct Lanes {
  hn::Vec<FourTag> v;

  static HWY_INLINE Lanes Set(double x) { return {hn::Set(FourTag(), x)}; }
  static HWY_INLINE Lanes First(double x) {
    return {hn::InsertLane(hn::Zero(FourTag()), 0, x)};
  }
  static HWY_INLINE Lanes Signs(double a, double b, double c, double d) {
    const double signs[4] = {a, b, c, d};
    return Load(signs);
  }
  static HWY_INLINE Lanes Load(const double* p) {
    return {hn::LoadU(FourTag(), p)};
  }
  HWY_INLINE void Store(double* p) const { hn::StoreU(v, FourTag(), p); }
  static HWY_INLINE Lanes LoadPairs(const double* p) {
    return {hn::Combine(FourTag(), hn::LoadU(PairTag(), p + 2),
                        hn::LoadU(PairTag(), p))};
  }
  HWY_INLINE void StorePairs(double* p) const {
    hn::StoreU(hn::LowerHalf(PairTag(), v), PairTag(), p);
    StoreLastPair(p + 2);
  }
  HWY_INLINE void StoreLastPair(double* p) const {
    hn::StoreU(hn::UpperHalf(PairTag(), v), PairTag(), p);
  }
};

// Lane i of the result is lane `from`[i].
HWY_INLINE Lanes Permuted(const Lanes& a, const int64_t* from) {
  return {hn::TableLookupLanes(a.v, hn::SetTableIndices(FourTag(), from))};
}

HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
  return {hn::Add(a.v, b.v)};
}
HWY_INLINE Lanes operator-(const Lanes& a, const Lanes& b) {
  return {hn::Sub(a.v, b.v)};
}
HWY_INLINE Lanes operator*(const Lanes& a, const Lanes& b) {
  return {hn::Mul(a.v, b.v)};
}
HWY_INLINE Lanes operator/(const Lanes& a, const Lanes& b) {
  return {hn::Div(a.v, b.v)};
}
HWY_INLINE Lanes Max(const Lanes& a, const Lanes& b) {
  return {hn::Max(a.v, b.v)};
}
HWY_INLINE Lanes Abs(const Lanes& a) { return {hn::Abs(a.v)}; }
HWY_INLINE Lanes Next(const Lanes& a) {
  static constexpr int64_t kFrom[4] = {0, 2, 3, 1};
  return Permuted(a, kFrom);
}
HWY_INLINE Lanes Previous(const Lanes& a) {
  static constexpr int64_t kFrom[4] = {0, 3, 1, 2};
  return Permuted(a, kFrom);
}
template <int i>
HWY_INLINE Lanes Broadcast(const Lanes& a) {
  static constexpr int64_t kFrom[4] = {i, i, i, i};
  return Permuted(a, kFrom);
}
HWY_INLINE Lanes SwapInPairs(const Lanes& a) {
  return {hn::Reverse2(FourTag(), a.v)};
}
HWY_INLINE Lanes SwapPairs(const Lanes& a) {
  return {hn::ConcatLowerUpper(FourTag(), a.v, a.v)};
}
// a b − c, rounded once: only where the machine has it.
HWY_INLINE Lanes MulSub(const Lanes& a, const Lanes& b, const Lanes& c) {
  return {hn::MulSub(a.v, b.v, c.v)};
}
HWY_INLINE Lanes WithoutFirst(const Lanes& a) {
  return {hn::IfThenZeroElse(hn::FirstN(FourTag(), 1), a.v)};
}
HWY_INLINE Lanes SelectFirst(const Lanes& first, const Lanes& others) {
  return {hn::IfThenElse(hn::FirstN(FourTag(), 1), first.v, others.v)};
}
HWY_INLINE Lanes SelectLast(const Lanes& others, const Lanes& last) {
  return {hn::IfThenElse(hn::FirstN(FourTag(), 3), others.v, last.v)};
}
HWY_INLINE Lanes FromSecond(const Lanes& a) {
  static constexpr int64_t kFrom[4] = {1, 2, 3, 0};
  return Permuted(a, kFrom);
}
HWY_INLINE Lanes FromLast(const Lanes& a) {
  static constexpr int64_t kFrom[4] = {3, 0, 1, 2};
  return Permuted(a, kFrom);
}
HWY_INLINE void LoadInterleaved(const double* p, Lanes* x, Lanes* y, Lanes* z) {
  hn::LoadInterleaved3(FourTag(), p, x->v, y->v, z->v);
}
HWY_INLINE void StoreInterleaved(const Lanes& x, const Lanes& y, const Lanes& z,
                                 double* p) {
  hn::StoreInterleaved3(x.v, y.v, z.v, FourTag(), p);
}

#else

namespace hn = hwy::HWY_NAMESPACE;
using TwoTag = hn::FixedTag<double, 2>;

struct Lanes {
  hn::Vec<TwoTag> low, high;

  static HWY_INLINE Lanes Set(double x) {
    return {hn::Set(TwoTag(), x), hn::Set(TwoTag(), x)};
  }
  static HWY_INLINE Lanes First(double x) {
    return {hn::InsertLane(hn::Zero(TwoTag()), 0, x), hn::Zero(TwoTag())};
  }
  static HWY_INLINE Lanes Signs(double a, double b, double c, double d) {
    const double signs[4] = {a, b, c, d};
    return Load(signs);
  }
  static HWY_INLINE Lanes Load(const double* p) {
    return {hn::LoadU(TwoTag(), p), hn::LoadU(TwoTag(), p + 2)};
  }
  HWY_INLINE void Store(double* p) const {
    hn::StoreU(low, TwoTag(), p);
    hn::StoreU(high, TwoTag(), p + 2);
  }
  static HWY_INLINE Lanes LoadPairs(const double* p) { return Load(p); }
  HWY_INLINE void StorePairs(double* p) const { Store(p); }
  HWY_INLINE void StoreLastPair(double* p) const {
    hn::StoreU(high, TwoTag(), p);
  }
};

HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
  return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)};
}
HWY_INLINE Lanes operator-(const Lanes& a, const Lanes& b) {
  return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)};
}
HWY_INLINE Lanes operator*(const Lanes& a, const Lanes& b) {
  return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)};
}
HWY_INLINE Lanes operator/(const Lanes& a, const Lanes& b) {
  return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)};
}
HWY_INLINE Lanes Max(const Lanes& a, const Lanes& b) {
  return {hn::Max(a.low, b.low), hn::Max(a.high, b.high)};
}
HWY_INLINE Lanes Abs(const Lanes& a) {
  return {hn::Abs(a.low), hn::Abs(a.high)};
}
HWY_INLINE Lanes Next(const Lanes& a) {
  return {hn::InterleaveLower(TwoTag(), a.low, a.high),
          hn::InterleaveUpper(TwoTag(), a.high, a.low)};
}
HWY_INLINE Lanes Previous(const Lanes& a) {
  return {hn::ConcatUpperLower(TwoTag(), a.high, a.low),
          hn::CombineShiftRightBytes<8>(TwoTag(), a.high, a.low)};
}
template <int i>
HWY_INLINE Lanes Broadcast(const Lanes& a) {
  const auto lane = hn::Broadcast<i % 2>(i < 2 ? a.low : a.high);
  return {lane, lane};
}
HWY_INLINE Lanes SwapInPairs(const Lanes& a) {
  return {hn::Shuffle01(a.low), hn::Shuffle01(a.high)};
}
HWY_INLINE Lanes SwapPairs(const Lanes& a) { return {a.high, a.low}; }
HWY_INLINE Lanes MulSub(const Lanes& a, const Lanes& b, const Lanes& c) {
  return {hn::MulSub(a.low, b.low, c.low), hn::MulSub(a.high, b.high, c.high)};
}
HWY_INLINE Lanes WithoutFirst(const Lanes& a) {
  return {hn::IfThenZeroElse(hn::FirstN(TwoTag(), 1), a.low), a.high};
}
HWY_INLINE Lanes SelectFirst(const Lanes& first, const Lanes& others) {
  return {hn::IfThenElse(hn::FirstN(TwoTag(), 1), first.low, others.low),
          others.high};
}
HWY_INLINE Lanes SelectLast(const Lanes& others, const Lanes& last) {
  return {others.low,
          hn::IfThenElse(hn::FirstN(TwoTag(), 1), others.high, last.high)};
}
HWY_INLINE Lanes FromSecond(const Lanes& a) {
  return {hn::CombineShiftRightBytes<8>(TwoTag(), a.high, a.low),
          hn::CombineShiftRightBytes<8>(TwoTag(), a.low, a.high)};
}
HWY_INLINE Lanes FromLast(const Lanes& a) {
  return {hn::CombineShiftRightBytes<8>(TwoTag(), a.low, a.high),
          hn::CombineShiftRightBytes<8>(TwoTag(), a.high, a.low)};
}
HWY_INLINE void LoadInterleaved(const double* p, Lanes* x, Lanes* y, Lanes* z) {
  hn::LoadInterleaved3(TwoTag(), p, x->low, y->low, z->low);
  hn::LoadInterleaved3(TwoTag(), p + 6, x->high, y->high, z->high);
}
HWY_INLINE void StoreInterleaved(const Lanes& x, const Lanes& y, const Lanes& z,
                                 double* p) {
  hn::StoreInterleaved3(x.low, y.low, z.low, TwoTag(), p);
  hn::StoreInterleaved3(x.high, y.high, z.high, TwoTag(), p + 6);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_FOUR_LANES_INL_H_
