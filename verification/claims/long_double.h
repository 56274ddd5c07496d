// What claims that are checked in long double share: its types, and samples.

#ifndef EMMY_VERIFICATION_CLAIMS_LONG_DOUBLE_H_
#define EMMY_VERIFICATION_CLAIMS_LONG_DOUBLE_H_

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "emmy/base/types.h"

namespace emmy::verification {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;

constexpr Real Wide(double x) { return static_cast<Real>(x); }
constexpr double Narrow(Real x) { return static_cast<double>(x); }

// Evenly in [-1, 1), the same numbers with every standard library.
class SampleSource {
 public:
  explicit SampleSource(uint64_t seed) : engine_(seed) {}

  double Next() {
    return 2.0 * static_cast<double>(engine_() >> 11U) * 0x1p-53 - 1.0;
  }

  // Entries in [-size, size).
  template <typename Matrix>
  Matrix Entries(double size) {
    Matrix m;
    for (Eigen::Index i = 0; i < m.size(); ++i) m(i) = size * Next();
    return m;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_CLAIMS_LONG_DOUBLE_H_
