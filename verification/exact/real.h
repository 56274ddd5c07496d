// The real types the closed-form solutions are instantiated for.
//
// Every solution here is a template on the real type T, compiled for double
// and for Quad. A reference value is computed in Quad and rounded once; the
// double version is there for speed, and is held to the Quad version by tests.

#ifndef EMMY_VERIFICATION_EXACT_REAL_H_
#define EMMY_VERIFICATION_EXACT_REAL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <limits>

namespace emmy::exact {

// IEEE binary128: 113 bits, ε = 1.9e-34, range 1e±4932. Needs no library at
// run time and is the same with every compiler.
using Quad = boost::multiprecision::cpp_bin_float_quad;

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Vector4 = Eigen::Matrix<T, 4, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

// ε = 2u, the distance from 1 to the next number.
template <typename T>
T Epsilon() {
  return std::numeric_limits<T>::epsilon();
}

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_REAL_H_
