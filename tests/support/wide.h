// A real type of 100 decimal digits: what a double or a double-double result
// is compared with. In it every test formula is exact for our purpose.

#ifndef EMMY_TESTS_SUPPORT_WIDE_H_
#define EMMY_TESTS_SUPPORT_WIDE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/double_double.h"
#include "emmy/base/types.h"

namespace emmy {

using Wide =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                  boost::multiprecision::et_off>;
using WideVector3 = Eigen::Matrix<Wide, 3, 1>;
using WideVector6 = Eigen::Matrix<Wide, 6, 1>;
using WideMatrix3 = Eigen::Matrix<Wide, 3, 3>;

inline Wide ToWide(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }

inline WideVector3 ToWide(const DoubleDouble3& v) {
  return {ToWide(v[0]), ToWide(v[1]), ToWide(v[2])};
}

inline WideMatrix3 ToWide(const std::array<DoubleDouble3, 3>& columns) {
  WideMatrix3 m;
  for (int j = 0; j < 3; ++j) {
    m.col(j) = ToWide(columns[static_cast<size_t>(j)]);
  }
  return m;
}

// `size` entries from `offset`, values plus compensations.
template <int size>
Eigen::Matrix<Wide, size, 1> ToWide(const CompensatedVector& v,
                                    Eigen::Index offset) {
  Eigen::Matrix<Wide, size, 1> wide;
  for (int i = 0; i < size; ++i) {
    wide(i) = Wide(v.value(offset + i)) + Wide(v.compensation(offset + i));
  }
  return wide;
}

// Three columns from `offset` on.
inline WideMatrix3 ToWideColumns(const CompensatedVector& v,
                                 Eigen::Index offset) {
  WideMatrix3 m;
  for (int j = 0; j < 3; ++j) m.col(j) = ToWide<3>(v, offset + 3 * j);
  return m;
}

inline double ToDouble(const Wide& x) { return x.convert_to<double>(); }

// Largest absolute entry, rounded once.
template <typename Derived>
double MaxAbs(const Eigen::MatrixBase<Derived>& m) {
  Wide largest = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      const Wide size = abs(Wide(m(i, j)));
      if (!(size <= largest)) largest = size;  // NaN is not lost.
    }
  }
  return ToDouble(largest);
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_WIDE_H_
