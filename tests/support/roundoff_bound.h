// Bounds on rounding errors, so that a tolerance is a count and not a guess.

#ifndef EMMY_TESTS_SUPPORT_ROUNDOFF_BOUND_H_
#define EMMY_TESTS_SUPPORT_ROUNDOFF_BOUND_H_

#include <cmath>
#include <cstdint>

#include "emmy/numerics/unit_roundoff.h"

namespace emmy {

// Bound for `num_ops` operations on terms whose absolute values add up to
// `magnitude` (same unit as the result): γ_n · magnitude with
// γ_n = n u / (1 − n u). Higham, Accuracy and Stability of Numerical
// Algorithms, 2nd ed., Lemma 3.1.
constexpr double RoundoffBound(int num_ops, double magnitude) {
  const double nu = num_ops * kUnitRoundoff;
  return nu / (1.0 - nu) * magnitude;
}

// Bound for the sum of `num_steps` independent errors of mean zero and size up
// to `step_bound`: 6 √n · step_bound, exceeded with a probability below
// 2 exp(−18) = 3e-8 (Hoeffding; Higham and Mary, SIAM J. Sci. Comput. 41
// (2019), for rounding errors).
inline double RandomWalkBound(int64_t num_steps, double step_bound) {
  return 6.0 * std::sqrt(static_cast<double>(num_steps)) * step_bound;
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_ROUNDOFF_BOUND_H_
