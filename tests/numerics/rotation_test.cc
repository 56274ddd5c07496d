#include "emmy/numerics/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kTrials = 500;

double MaxDifference(const Matrix3d& a, const Matrix3d& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// The rotation by `angle` about the unit vector `axis`, independently of the
// code under test.
WideMatrix3 WideRotation(const Vector3d& axis, const Wide& angle) {
  WideVector3 n = axis.cast<Wide>();
  n /= sqrt(Wide(n.dot(n)));
  return Eigen::AngleAxis<Wide>(angle, n).toRotationMatrix();
}

WideMatrix3 WideRotation(const Vector4d& quaternion) {
  Eigen::Quaternion<Wide> q(quaternion(0), quaternion(1), quaternion(2),
                            quaternion(3));
  q.coeffs() /= sqrt(Wide(q.coeffs().dot(q.coeffs())));
  return q.toRotationMatrix();
}

TEST(HatTest, IsTheCrossProductBitForBit) {
  RandomSource random(20250201);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d a = random.Vector(10.0);
    const Vector3d b = random.Vector(10.0);
    EXPECT_EQ(Vector3d(Hat(a) * b), a.cross(b));
  }
}

TEST(AxialTest, UndoesHatExactly) {
  RandomSource random(20250202);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d a = random.Vector(10.0);
    EXPECT_EQ(Axial(Hat(a)), a);
  }
}

TEST(AxialTest, SeesOnlyTheAntisymmetricPart) {
  RandomSource random(20250203);
  const auto m = random.Entries<Matrix3d>(1.0);
  const Matrix3d symmetric = m + m.transpose();
  EXPECT_EQ(Axial(symmetric), Vector3d(Vector3d::Zero()));
}

// (ROT-3) in 100 digits; about 20 operations, all relative to 1.
TEST(CayleyRotationTest, IsTheCayleyFormulaForAnySize) {
  RandomSource random(20250204);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d theta =
        std::abs(random.Magnitude(1e-12, 1e6)) * random.Direction<Vector3d>();
    const WideMatrix3 half = Hat(theta).cast<Wide>() / 2;
    const WideMatrix3 one = WideMatrix3::Identity();
    const WideMatrix3 exact = (one - half).inverse() * (one + half);
    EXPECT_LE(MaxAbs(CayleyRotation(theta).cast<Wide>() - exact),
              RoundoffBound(20, 1.0))
        << theta.norm();
  }
}

TEST(CayleyRotationTest, TurnsByTwiceTheArcTangentOfHalfTheLength) {
  const Matrix3d r = CayleyRotation({0.0, 0.0, 2.0});
  EXPECT_LE(MaxDifference(r, Hat({0.0, 0.0, 1.0}) +
                                 Matrix3d(Vector3d(0, 0, 1).asDiagonal())),
            RoundoffBound(4, 1.0));
}

TEST(QuaternionProductTest, IsTheProductOfTheRotations) {
  RandomSource random(20250205);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector4d p = random.UnitQuaternion();
    const Vector4d q = random.UnitQuaternion();
    const WideMatrix3 exact = WideRotation(q) * WideRotation(p);
    EXPECT_LE(MaxAbs(QuaternionToMatrix(QuaternionProduct(q, p)).cast<Wide>() -
                     exact),
              RoundoffBound(40, 1.0));
  }
}

class QuaternionTest : public ::testing::TestWithParam<double> {};

// (ROT-5): relative to the increment itself, which a difference of two unit
// quaternions could not give for a small Θ.
TEST_P(QuaternionTest, CayleyIncrementIsAccurateRelativeToItself) {
  RandomSource random(20250206);
  for (int trial = 0; trial < kTrials / 5; ++trial) {
    const Vector3d theta = GetParam() * random.Direction<Vector3d>();
    const Vector4d q0 = random.UnitQuaternion();
    const Wide n = sqrt(Wide(1 + Wide(theta.cast<Wide>().squaredNorm()) / 4));
    const Eigen::Quaternion<Wide> start(q0(0), q0(1), q0(2), q0(3));
    const Eigen::Quaternion<Wide> turn(1 / n, theta(0) / (2 * n),
                                       theta(1) / (2 * n), theta(2) / (2 * n));
    const Eigen::Quaternion<Wide> end = start * turn;
    const Vector4d increment = CayleyQuaternionIncrement(q0, theta);
    Eigen::Matrix<Wide, 4, 1> exact(end.w() - start.w(), end.x() - start.x(),
                                    end.y() - start.y(), end.z() - start.z());
    // 8 operations for a factor, 7 for the product's sums.
    EXPECT_LE(MaxAbs(increment.cast<Wide>() - exact),
              RoundoffBound(15, 2.0 * increment.norm()))
        << "trial " << trial;
  }
}

TEST_P(QuaternionTest, RotationVectorTurnsByItsLength) {
  RandomSource random(20250207);
  for (int trial = 0; trial < kTrials / 5; ++trial) {
    const Vector3d axis = random.Direction<Vector3d>();
    const Vector3d vector = GetParam() * axis;
    const WideVector3 wide = vector.cast<Wide>();
    const WideMatrix3 exact =
        WideRotation(axis, Wide(sqrt(Wide(wide.dot(wide)))));
    const Matrix3d r = QuaternionToMatrix(RotationVectorToQuaternion(vector));
    // The angle is rounded by 3 u, which the sine passes on.
    EXPECT_LE(MaxAbs(r.cast<Wide>() - exact),
              RoundoffBound(24, 1.0 + GetParam()));
  }
}

// Near 180° w passes zero: the divisor must be another component there.
TEST_P(QuaternionTest, MatrixToQuaternionGivesTheRotationBack) {
  RandomSource random(20250208);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d axis = random.Direction<Vector3d>();
    const Matrix3d rotation =
        WideRotation(axis, Wide(GetParam())).cast<double>();
    const Vector4d q = MatrixToQuaternion(rotation);
    EXPECT_GE(q(0), 0.0);
    EXPECT_NEAR(q.norm(), 1.0, RoundoffBound(4, 1.0));
    EXPECT_LE(MaxDifference(QuaternionToMatrix(q), rotation),
              RoundoffBound(32, 1.0))
        << "trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, QuaternionTest,
                         ::testing::Values(1e-40, 1e-12, 1e-6, 0.1, 1.0, 2.0,
                                           std::numbers::pi - 1e-9,
                                           std::numbers::pi,
                                           std::numbers::pi + 1e-7, 5.0));

TEST(MatrixToQuaternionTest, HalfTurnsAboutTheAxesAreExact) {
  for (int i = 0; i < 3; ++i) {
    Vector3d signs = Vector3d::Constant(-1.0);
    signs(i) = 1.0;
    EXPECT_EQ(MatrixToQuaternion(signs.asDiagonal()), Vector4d::Unit(1 + i));
  }
}

TEST(RotationVectorToQuaternionTest, ZeroIsTheIdentity) {
  EXPECT_EQ(RotationVectorToQuaternion(Vector3d::Zero()), Vector4d::Unit(0));
}

TEST(QuaternionToMatrixTest, DoesNotDependOnTheLength) {
  RandomSource random(20250209);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector4d q =
        random.Magnitude(1e-100, 1e100) * random.UnitQuaternion();
    EXPECT_LE(MaxAbs(QuaternionToMatrix(q).cast<Wide>() - WideRotation(q)),
              RoundoffBound(24, 1.0));
  }
}

// About 30 operations of up to 15 u² each.
constexpr double kExtendedBound = 450.0 * kUnitRoundoff * kUnitRoundoff;

TEST(QuaternionToMatrixTest, ExtendedColumnsAreOrthonormalToThirtyDigits) {
  RandomSource random(20250210);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector4d q = random.Magnitude(1e-3, 1e3) * random.UnitQuaternion();
    const WideMatrix3 r = ToWide(QuaternionToMatrix(
        std::array<DoubleDouble, 4>{q(0), q(1), q(2), q(3)}));
    EXPECT_LE(MaxAbs(r.transpose() * r - WideMatrix3::Identity()),
              kExtendedBound);
    EXPECT_LE(MaxAbs(r - WideRotation(q)), kExtendedBound);
    EXPECT_GT(ToDouble(Wide(r.determinant())), 0.0);
  }
}

// The check above sees a matrix that is a rotation to 1e-16 only.
TEST(QuaternionToMatrixTest, DoubleColumnsAreNotOrthonormalToThirtyDigits) {
  RandomSource random(20250211);
  const WideMatrix3 r =
      QuaternionToMatrix(random.UnitQuaternion()).cast<Wide>();
  EXPECT_GT(MaxAbs(r.transpose() * r - WideMatrix3::Identity()),
            1e6 * kExtendedBound);
}

}  // namespace
}  // namespace emmy
