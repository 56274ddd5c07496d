// Sums and products with what they round off, in every lane of a type V of
// numbers side by side: TwoSum and TwoProduct of compensated_sum.h and
// double_double.h.
//
// V has +, − and *, V::Set(x) for x in every lane, and MulSub(a, b, c) for
// a b − c, of which the fused operation is used where there is one.
//
// Not covered: products below 1e-290 or above 1e290, as there.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_ERROR_FREE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_ERROR_FREE_LANES_INL_H_
#undef EMMY_NUMERICS_ERROR_FREE_LANES_INL_H_
#else
#define EMMY_NUMERICS_ERROR_FREE_LANES_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// A number and what it lacks, in every lane.
template <typename V>
struct WithError {
  V value, error;
};

// (SUM-1)
template <typename V>
HWY_INLINE WithError<V> TwoSum(const V& a, const V& b) {
  const V sum = a + b;
  const V b_part = sum - a;
  const V a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// (SUM-1) if |a| ≥ |b|; else the error is wrong by at most a rounding of b.
template <typename V>
HWY_INLINE WithError<V> FastTwoSum(const V& a, const V& b) {
  const V sum = a + b;
  return {sum, b - (sum - a)};
}
template <typename V>
HWY_INLINE WithError<V> FastTwoDifference(const V& a, const V& b) {
  const V difference = a - b;
  return {difference, (a - difference) - b};
}

// (SUM-3), with the same bits by a fused operation as without.
template <typename V>
HWY_INLINE WithError<V> TwoProduct(const V& a, const V& b) {
  const V product = a * b;
#if HWY_TARGET != HWY_SCALAR && HWY_NATIVE_FMA
  return {product, MulSub(a, b, product)};
#else
  const V split = V::Set(134217729.0);  // 2²⁷ + 1.
  const V a_scaled = split * a;
  const V a_high = a_scaled - (a_scaled - a);
  const V a_low = a - a_high;
  const V b_scaled = split * b;
  const V b_high = b_scaled - (b_scaled - b);
  const V b_low = b - b_high;
  return {product,
          ((a_high * b_high - product) + a_high * b_low + a_low * b_high) +
              a_low * b_low};
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_ERROR_FREE_LANES_INL_H_
