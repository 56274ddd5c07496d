// What the steps of free bodies in SIMD lanes have in common: the centre of
// mass and the start value of the next iteration.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_INTEGRATE_BODY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_INTEGRATE_BODY_LANES_INL_H_
#undef EMMY_INTEGRATE_BODY_LANES_INL_H_
#else
#define EMMY_INTEGRATE_BODY_LANES_INL_H_
#endif

#include <cstddef>

#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/extrapolation.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// Δx̄ as a pair, of the centre's three numbers and one that means nothing. A
// free body's velocity is the same in every step, and so would be the rounding
// of the product, which then drifts.
HWY_INLINE LanesSum CentreMotion(const Lanes& velocity_increment,
                                 const double* velocity,
                                 const double* compensation,
                                 const Lanes& step) {
  return TwoProduct(
      step, Lanes::Load(velocity) + (Lanes::Load(compensation) +
                                     Lanes::Set(0.5) * velocity_increment));
}

// Extrapolation::Add and Predict (EXTRA-1) for the accelerations of a step,
// four of them in each of `values`; `differences` by order.
template <size_t kVectors>
HWY_INLINE void Extrapolate(const Lanes (&values)[kVectors],
                            double* const* differences, double* next) {
  constexpr int kOrders = Extrapolation::kOrders;
  Lanes errors[kOrders];
  for (int j = 0; j < kOrders; ++j) errors[j] = Lanes::Set(0.0);
  for (size_t i = 0; i < kVectors; ++i) {
    Lanes difference = values[i];
    for (int j = 0; j < kOrders; ++j) {
      const Lanes change = difference - Lanes::Load(differences[j] + 4 * i);
      difference.Store(differences[j] + 4 * i);
      difference = change;
      errors[j] = Max(errors[j], Abs(change));
    }
  }
  Extrapolation::Errors largest;
  for (size_t j = 0; j < largest.size(); ++j) largest[j] = Largest(errors[j]);
  const int order = Extrapolation::BestOrder(largest);
  for (size_t i = 0; i < kVectors; ++i) {
    Lanes sum = Lanes::Load(differences[order] + 4 * i);
    for (int j = order - 1; j >= 0; --j) {
      sum = sum + Lanes::Load(differences[j] + 4 * i);
    }
    sum.Store(next + 4 * i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_INTEGRATE_BODY_LANES_INL_H_
