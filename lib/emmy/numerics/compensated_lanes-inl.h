// Compensated sums of four numbers side by side: compensated_sum.h for Lanes.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_COMPENSATED_LANES_INL_H_) == \
    defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#undef EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#else
#define EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
#endif

#include <algorithm>

#include "emmy/numerics/error_free_lanes-inl.h"
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

// Whether the last three lanes are finite; a maximum may lose a NaN.
HWY_INLINE bool IsFiniteOfBody(const Lanes& a) {
  alignas(32) double rest[4];
  (a - a).Store(rest);  // NOLINT(misc-redundant-expression)
  return rest[1] == 0.0 && rest[2] == 0.0 && rest[3] == 0.0;
}

using LanesSum = WithError<Lanes>;

// (SUM-2) for four numbers.
HWY_INLINE void AddTo(const Lanes& increment, double* value,
                      double* compensation) {
  const LanesSum sum =
      TwoSum(Lanes::Load(value), increment + Lanes::Load(compensation));
  sum.value.Store(value);
  sum.error.Store(compensation);
}

// Of a pair, which is not rounded before it is added.
HWY_INLINE void AddPairTo(const LanesSum& increment, double* value,
                          double* compensation) {
  const LanesSum first = TwoSum(Lanes::Load(value), increment.value);
  const LanesSum second = TwoSum(
      first.value, first.error + (Lanes::Load(compensation) + increment.error));
  second.value.Store(value);
  second.error.Store(compensation);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_COMPENSATED_LANES_INL_H_
