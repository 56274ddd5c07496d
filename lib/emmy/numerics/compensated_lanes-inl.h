// Error-free sums and products of four numbers side by side: compensated_sum.h
// and double_double.h for Lanes.
//
// Not covered: products below 1e-290 or above 1e290, as there.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_COMPENSATED_LANES_INL_H_) == \
    defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#undef EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#else
#define EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#endif

#include <algorithm>

#include "emmy/numerics/four_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// The largest number of all lanes.
HWY_INLINE double Largest(const Lanes& a) {
  alignas(32) double lanes[4];
  a.Store(lanes);
  return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3]));
}

// Of the last three lanes, the first being the centre's.
HWY_INLINE double LargestOfBody(const Lanes& a) {
  alignas(32) double lanes[4];
  a.Store(lanes);
  return std::max(std::max(lanes[1], lanes[2]), lanes[3]);
}

// A number and what it lacks, in every lane.
struct LanesSum {
  Lanes value, error;
};

// (SUM-1)
HWY_INLINE LanesSum TwoSum(const Lanes& a, const Lanes& b) {
  const Lanes sum = a + b;
  const Lanes b_part = sum - a;
  const Lanes a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// (SUM-3), with the same bits by a fused operation as without.
HWY_INLINE LanesSum TwoProduct(const Lanes& a, const Lanes& b) {
#if HWY_TARGET != HWY_SCALAR && HWY_NATIVE_FMA
  const Lanes product = a * b;
  return {product, MulSub(a, b, product)};
#else
  const Lanes split = Lanes::Set(134217729.0);  // 2^27 + 1.
  const Lanes product = a * b;
  const Lanes a_scaled = split * a;
  const Lanes a_high = a_scaled - (a_scaled - a);
  const Lanes a_low = a - a_high;
  const Lanes b_scaled = split * b;
  const Lanes b_high = b_scaled - (b_scaled - b);
  const Lanes b_low = b - b_high;
  return {product,
          ((a_high * b_high - product) + a_high * b_low + a_low * b_high) +
              a_low * b_low};
#endif
}

// (SUM-2) for four numbers.
HWY_INLINE void AddTo(const Lanes& increment, double* value,
                      double* compensation) {
  const LanesSum sum =
      TwoSum(Lanes::Load(value), increment + Lanes::Load(compensation));
  sum.value.Store(value);
  sum.error.Store(compensation);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
