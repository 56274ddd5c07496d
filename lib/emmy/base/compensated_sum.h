// Sums that lose nothing: error-free addition and compensated vectors.
//
//   TwoSum: a + b = s + r exactly, s = fl(a + b)                  (SUM-1)
//   CompensatedVector: x = value + compensation, |compensation| at most half
//   a unit in the last place of value; x += d is TwoSum(value, d +
//   compensation)                                                 (SUM-2)
//
// A state advanced by (SUM-2) carries the low-order part that an ordinary
// addition of a small step to a large value would drop, so that n steps leave
// an error of about n u² |x| + √n u |d| instead of √n u |x|.
//
// Sources: Knuth, TAOCP 2, 4.2.2; Neumaier, ZAMM 54 (1974).
// Not covered: overflow. Needs IEEE arithmetic without value-changing
// optimisation (no -ffast-math).

#ifndef EMMY_BASE_COMPENSATED_SUM_H_
#define EMMY_BASE_COMPENSATED_SUM_H_

#include "emmy/base/types.h"

namespace emmy {

// The rounded sum of two numbers and its exact rounding error.
struct SumAndError {
  double sum;    // fl(a + b)
  double error;  // a + b − sum, itself a double.
};

// (SUM-1); exact for any order of magnitude of a and b.
inline SumAndError TwoSum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// (SUM-2) for one number.
inline void AddCompensated(double increment, double& value,
                           double& compensation) {
  const SumAndError result = TwoSum(value, increment + compensation);
  value = result.sum;
  compensation = result.error;
}

// (SUM-2) for an increment with a low-order part of its own, which an addition
// to the compensation alone would round off.
inline void AddCompensated(double increment, double low_part, double& value,
                           double& compensation) {
  const SumAndError first = TwoSum(value, increment);
  const SumAndError second =
      TwoSum(first.sum, first.error + (compensation + low_part));
  value = second.sum;
  compensation = second.error;
}

// A number advanced by compensated summation.
struct CompensatedDouble {
  double value = 0.0;         // The nearest double.
  double compensation = 0.0;  // What `value` could not hold.

  // (SUM-2)
  void Add(double increment) { AddCompensated(increment, value, compensation); }
};

// A vector advanced by compensated summation.
struct CompensatedVector {
  VectorXd value;         // The nearest doubles.
  VectorXd compensation;  // What `value` could not hold, of its size.

  // Zero, of `size` entries.
  void SetZero(Eigen::Index size) {
    value.setZero(size);
    compensation.setZero(size);
  }

  // (SUM-2) for the entries [offset, offset + increment.size()).
  template <typename Derived>
  void Add(Eigen::Index offset, const Eigen::MatrixBase<Derived>& increment) {
    for (Eigen::Index i = 0; i < increment.size(); ++i) {
      AddCompensated(increment(i), value(offset + i), compensation(offset + i));
    }
  }
};

}  // namespace emmy

#endif  // EMMY_BASE_COMPENSATED_SUM_H_
