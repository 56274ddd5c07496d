#include "verification/exact/attitude.h"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>

#include "tests/exact/regimes.h"
#include "verification/exact/principal_axes.h"

namespace emmy::exact {
namespace {

template <typename T>
class AttitudeTest : public ::testing::Test {
 protected:
  static T Worst(const Matrix3<T>& a, const Matrix3<T>& b) {
    return (a - b).cwiseAbs().maxCoeff() / UnitRoundoff<T>();
  }
};

using RealTypes = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(AttitudeTest, RealTypes);

// Angles up to a half turn, where the quaternion's w vanishes.
TYPED_TEST(AttitudeTest, QuaternionAndMatrixAreInverse) {
  using T = TypeParam;
  for (const Vector4<T>& q :
       {Vector4<T>(1, 0, 0, 0), Vector4<T>(3, -1, 2, 5),
        Vector4<T>(0, 1, 2, -3), Vector4<T>(T{1e-9}, -7, 1, 1),
        Vector4<T>(1, T{1e-9}, 0, 0)}) {
    using std::sqrt;
    const Vector4<T> unit = q / sqrt(q.squaredNorm());
    const Vector4<T> back = QuaternionFromRotation(RotationFromQuaternion(q));
    const bool same_sign = back.dot(unit) > 0;
    const Vector4<T> error =
        same_sign ? Vector4<T>(back - unit) : Vector4<T>(back + unit);
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 8 * UnitRoundoff<T>());
    EXPECT_GE(back(0), T{0});
  }
}

TYPED_TEST(AttitudeTest, RotationVectorTurnsCounterclockwise) {
  using T = TypeParam;
  const T& half_pi = boost::math::constants::half_pi<T>();
  Matrix3<T> expected;
  expected << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LE(
      this->Worst(RotationFromVector(Vector3<T>(0, 0, half_pi)), expected),
      T{4});
  EXPECT_EQ(RotationFromVector(Vector3<T>(0, 0, 0)), (Matrix3<T>::Identity()));
}

TYPED_TEST(AttitudeTest, NearestRotationOfARoundedOneIsOrthonormal) {
  using T = TypeParam;
  const Matrix3<double> rounded =
      RotationFromQuaternion(Vector4<double>(3, -1, 2, 5));
  const Matrix3<T> r = NearestRotation<T>(rounded.cast<T>());
  EXPECT_LE(this->Worst(r.transpose() * r, Matrix3<T>::Identity()), T{8});
  EXPECT_LE((r - rounded.cast<T>()).cwiseAbs().maxCoeff(), T{4e-16});
}

TYPED_TEST(AttitudeTest, PrincipalAxesRebuildTheTensor) {
  using T = TypeParam;
  const Matrix3<T> turn = RotationFromQuaternion(Vector4<T>(3, -1, 2, 5));
  for (const Vector3<T>& moments :
       {Vector3<T>(2, 3, 4), Vector3<T>(3, 3, 4), Vector3<T>(2, 2, 2),
        Vector3<T>(T{1e-6}, 1, 1)}) {
    const Matrix3<T> full = turn * moments.asDiagonal() * turn.transpose();
    const Matrix3<T> tensor = (full + full.transpose()) / 2;
    const auto axes = FindPrincipalAxes<T>(tensor);
    ASSERT_TRUE(axes.ok()) << axes.status();
    EXPECT_LE(this->Worst(axes->axes * axes->moments.asDiagonal() *
                              axes->axes.transpose(),
                          tensor),
              T{64});
    EXPECT_LE(
        (axes->moments - moments).cwiseAbs().maxCoeff() / UnitRoundoff<T>(),
        T{64});
    EXPECT_GT(axes->axes.col(0).cross(axes->axes.col(1)).dot(axes->axes.col(2)),
              T{0});
  }
}

TYPED_TEST(AttitudeTest, DiagonalTensorIsOnlySorted) {
  using T = TypeParam;
  const Matrix3<T> tensor = Vector3<T>(T{0.7}, T{0.8}, T{0.3}).asDiagonal();
  const auto axes = FindPrincipalAxes<T>(tensor).value();
  EXPECT_EQ(axes.moments, (Vector3<T>(T{0.3}, T{0.7}, T{0.8})));
  EXPECT_EQ(axes.axes.cwiseAbs().sum(), T{3});
}

}  // namespace
}  // namespace emmy::exact
