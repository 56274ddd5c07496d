// Named starts of the torque-free body, shared by the tests. All data are
// exact in double, so that every real type starts from the same numbers.

#ifndef EMMY_TESTS_EXACT_REGIMES_H_
#define EMMY_TESTS_EXACT_REGIMES_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "verification/exact/attitude.h"
#include "verification/exact/free_rigid_body.h"

namespace emmy::exact {

struct Regime {
  const char* name;
  Polhode polhode;                      // What the start must be recognised as.
  Vector3<double> moments;              // Along the body axes, in any order.
  Vector3<double> omega;                // Body axes [rad/s].
  Vector4<double> tilt = {1, 0, 0, 0};  // Turns the tensor out of the axes.

  friend void PrintTo(const Regime& r, std::ostream* os) { *os << r.name; }

  // The tilted tensor is rounded once, here, then exact in every type.
  FreeRigidBodyStart<double> Start() const {
    FreeRigidBodyStart<double> start;
    const Matrix3<double> turn = RotationFromQuaternion(tilt);
    const Matrix3<double> j = turn * moments.asDiagonal() * turn.transpose();
    start.inertia = j.template selfadjointView<Eigen::Lower>();
    start.angular_velocity = turn * omega;
    start.attitude =
        RotationFromQuaternion(Vector4<double>(0.5, -0.25, 0.75, 1.0));
    return start;
  }

  // L / J₁, no smaller than any |ω| of a body with this L [rad/s].
  double Speed() const {
    const double speed =
        moments.cwiseProduct(omega).norm() / moments.minCoeff();
    return speed > 0 ? speed : 1.0;
  }
};

inline std::vector<Regime> Regimes() {
  constexpr double kTiny = 0x1p-40;  // 9.1e-13
  constexpr double kUlp = 0x1p-52;
  using enum Polhode;
  return {
      {"PaperBox", kAroundLargest, {6750, 13500, 17550}, {0.3, 0.5, 0.8}},
      {"AroundSmallest", kAroundSmallest, {2, 3, 4}, {1.0, 0.3, -0.2}},
      {"AroundLargest", kAroundLargest, {2, 3, 4}, {-0.2, 0.3, 1.0}},
      {"UnsortedAxes", kAroundSmallest, {3, 4, 2}, {0.25, -0.5, -1.5}},
      {"TiltedTensor",
       kAroundLargest,
       {2, 3, 4},
       {-0.2, 0.5, 1.0},
       {0.9, 0.1, -0.3, 0.2}},
      {"ThinPlate", kAroundSmallest, {0.001, 1, 1.0005}, {3.0, 0.01, 0.02}},
      {"GazeboBox",
       kAroundLargest,
       {0.80833333, 0.68333333, 0.14166667},
       {0.1, 5.0, 0.1}},
      {"NearMiddleAxis", kAroundSmallest, {3, 4, 6}, {1e-6, 1.0, 1e-7}},
      {"VeryNearMiddleAxis", kAroundLargest, {3, 4, 6}, {1e-20, -1.0, 1e-20}},
      {"OnSeparatrix", kSeparatrix, {3, 4, 6}, {2.0, -1.0, 1.0}},
      {"InsideSeparatrix", kAroundSmallest, {3, 4, 6}, {2 + 4 * kUlp, -1, 1}},
      {"OutsideSeparatrix", kAroundLargest, {3, 4, 6}, {2, -1, 1 + 2 * kUlp}},
      {"SpinAboutSmallest", kPoint, {2, 3, 4}, {1, 0, 0}},
      {"SpinAboutMiddle", kPoint, {2, 3, 4}, {0, -1, 0}},
      {"SpinAboutLargest", kPoint, {2, 3, 4}, {0, 0, 1}},
      {"NearSpinAboutSmallest", kAroundSmallest, {2, 3, 4}, {1, 1e-9, 2e-12}},
      {"NearSpinAboutLargest", kAroundLargest, {2, 3, 4}, {-1e-30, 0, 1}},
      {"OblateTop", kAroundLargest, {1, 1, 1.5}, {0.25, -0.5, 1}},
      {"ProlateTop", kAroundSmallest, {0.5, 1, 1}, {2, 0.5, 0.75}},
      {"EquatorOfTop", kPoint, {1, 1, 1.5}, {0.6, 0.8, 0}},
      {"NearEquatorOfTop", kAroundLargest, {1, 1, 1.5}, {0.6, 0.8, 1e-9}},
      {"NearlyTop", kAroundLargest, {1, 1 + kTiny, 1.5}, {0.25, -0.5, 1}},
      {"NearlyTopEquator",
       kAroundSmallest,
       {1, 1 + kTiny, 1.5},
       {1, 0.5, 1e-7}},
      {"NearlyTopGrazing",
       kAroundSmallest,
       {1, 1 + kTiny, 1.5},
       {1, 1e-9, 1e-7}},
      {"NearlyTopProlate", kAroundSmallest, {0.5, 1, 1 + kUlp}, {2, 0.5, 1}},
      {"Sphere", kPoint, {2, 2, 2}, {0.3, -0.4, 1}},
      {"NearlySphere",
       kAroundLargest,
       {2, 2 + 4 * kUlp, 2 + 6 * kUlp},
       {0.3, 0.4, 1}},
      {"Rest", kPoint, {2, 3, 4}, {0, 0, 0}},
  };
}

// For INSTANTIATE_TEST_SUITE_P.
inline std::string RegimeName(const ::testing::TestParamInfo<Regime>& regime) {
  return regime.param.name;
}

template <typename T>
FreeRigidBody<T> MakeBody(const FreeRigidBodyStart<double>& start) {
  return FreeRigidBody<T>::Create(start.Cast<T>()).value();
}

// u, half the distance from 1 to the next number.
template <typename T>
T UnitRoundoff() {
  return Epsilon<T>() / 2;
}

// The largest difference of attitude and of body ω relative to `speed`.
template <typename T>
T Distance(const FreeRigidBodyState<T>& a, const FreeRigidBodyState<T>& b,
           const T& speed) {
  const T attitude = (a.attitude - b.attitude).cwiseAbs().maxCoeff();
  const T omega = (a.body_angular_velocity - b.body_angular_velocity)
                      .cwiseAbs()
                      .maxCoeff() /
                  speed;
  // Written so that NaN is not lost.
  return attitude < omega ? omega : attitude;
}

}  // namespace emmy::exact

#endif  // EMMY_TESTS_EXACT_REGIMES_H_
