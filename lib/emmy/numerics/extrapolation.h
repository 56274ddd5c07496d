// The next value of a sequence, extrapolated from its last ones.
//
//   aₙ₊₁ ≈ Σ_{j ≤ p} ∇ʲ aₙ,  ∇⁰ a = a,  ∇ʲ⁺¹ aₙ = ∇ʲ aₙ − ∇ʲ aₙ₋₁     (EXTRA-1)
// is exact for a polynomial of degree p. What order p would have predicted for
// aₙ was wrong by ∇ᵖ⁺¹ aₙ; the next value is predicted with the order for
// which that was least. A smooth sequence is so predicted to third order,
// while one that vibrates from value to value stays at its last one.
//
// Only for start values of an iteration: a result depends on it by round-off,
// or by the iteration's tolerance. Steps of different sizes (compositions) make
// it a poorer guess, and lower orders are then chosen.

#ifndef EMMY_NUMERICS_EXTRAPOLATION_H_
#define EMMY_NUMERICS_EXTRAPOLATION_H_

#include <algorithm>
#include <array>
#include <cmath>

#include "emmy/base/types.h"

namespace emmy {

// A set of sequences, advanced together.
struct Extrapolation {
  static constexpr int kOrders = 4;  // p = 0 … 3.

  // Largest |∇ᵖ⁺¹ aₙ| by p.
  using Errors = std::array<double, kOrders>;

  VectorXd next;         // Prediction, one entry a sequence.
  MatrixXd differences;  // ∇⁰ … ∇³ of the last value, a column an order.

  // As after values that were all zero.
  void SetZero(Eigen::Index size) {
    next.setZero(size);
    differences.setZero(size, kOrders);
  }

  // Takes new values of the sequences from `offset` on; `errors` grows to
  // what each order would have missed them by.
  template <typename Derived>
  void Add(Eigen::Index offset, const Eigen::MatrixBase<Derived>& values,
           Errors* errors) {
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      double difference = values(i);
      for (int j = 0; j < kOrders; ++j) {
        double& kept = differences(offset + i, j);
        const double change = difference - kept;
        kept = difference;
        difference = change;
        double& error = (*errors)[static_cast<size_t>(j)];
        error = std::max(error, std::abs(difference));
      }
    }
  }

  // The order for which the errors are least.
  static int BestOrder(const Errors& errors) {
    return static_cast<int>(std::min_element(errors.begin(), errors.end()) -
                            errors.begin());
  }

  // Predicts `size` sequences from `offset` on with this order.
  void Predict(Eigen::Index offset, Eigen::Index size, int order) {
    for (Eigen::Index i = offset; i < offset + size; ++i) {
      double sum = 0.0;
      for (int j = order; j >= 0; --j) sum += differences(i, j);
      next(i) = sum;
    }
  }
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_EXTRAPOLATION_H_
