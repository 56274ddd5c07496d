#include "emmy/integrate/joint_compliance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <utility>

#include "emmy/element/ancf_rigid_body.h"
#include "emmy/numerics/rotation.h"
#include "tests/support/paper_box.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;

AncfRigidBody Box() { return PaperBoxElement(1e9); }

// How far a body is from its frame: a quarter of the turn, and the strain.
struct Deviation {
  Vector3d turn;
  Vector6d strain;
};

Matrix3d StrainMatrix(const Vector6d& e) {
  Matrix3d strain;
  strain << e(0), 0.5 * e(3), 0.5 * e(5),  //
      0.5 * e(3), e(1), 0.5 * e(4),        //
      0.5 * e(5), 0.5 * e(4), e(2);
  return strain;
}

// The tangent of (ANCF-6) between mean vectors `mean` and vectors `end` of the
// end, all of its terms, and the compliance of a pair of joints in space.
Matrix3d ExactCompliance(const AncfRigidBody& body, const Deviation& d,
                         const Matrix3d& frame, const Vector4d& g,
                         const Vector4d& h) {
  const Vector6d& e = d.strain;
  const Matrix3d strain = StrainMatrix(e);
  const Matrix3d end = frame * (Matrix3d::Identity() + Hat(d.turn) + strain);
  const Matrix3d mean = frame * (Matrix3d::Identity() - Hat(d.turn) + strain);
  const Vector6d& b = body.penalty_stiffness();
  const double quarter = 0.25 * kTimeStep * kTimeStep;
  Eigen::Matrix<double, 9, 9> k = Eigen::Matrix<double, 9, 9>::Zero();
  for (int i = 0; i < 3; ++i) {
    k.block<3, 3>(3 * i, 3 * i).diagonal().array() +=
        body.second_moment()(i, i);
  }
  const std::array<std::array<int, 2>, 6> pairs = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (int n = 0; n < 6; ++n) {
    const auto [i, j] = pairs[static_cast<size_t>(n)];
    Eigen::Matrix<double, 9, 1> force = Eigen::Matrix<double, 9, 1>::Zero();
    Eigen::Matrix<double, 9, 1> rate = Eigen::Matrix<double, 9, 1>::Zero();
    force.segment<3>(3 * i) += mean.col(j);
    rate.segment<3>(3 * i) += end.col(j);
    if (i != j) {
      force.segment<3>(3 * j) += mean.col(i);
      rate.segment<3>(3 * j) += end.col(i);
    }
    k += (quarter * b(n)) * force * rate.transpose();
    const double stress = quarter * b(n) * e(n);
    k.block<3, 3>(3 * i, 3 * j).diagonal().array() += stress;
    if (i != j) k.block<3, 3>(3 * j, 3 * i).diagonal().array() += stress;
  }
  const Eigen::Matrix<double, 9, 9> inverse = k.inverse();
  Matrix3d s = (g(0) * h(0) / body.mass()) * Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      s += g(1 + i) * h(1 + j) * inverse.block<3, 3>(3 * i, 3 * j);
    }
  }
  return s;
}

// Of the first-order compliance, relative to the whole.
double Error(double size, const Vector4d& g, const Vector4d& h) {
  const AncfRigidBody body = Box();
  const JointCompliance compliance(body, kTimeStep);
  const Deviation d = {
      size * Vector3d(0.5, -0.9, 0.3),
      size * (Vector6d() << 0.2, -0.3, 0.1, 0.25, -0.15, 0.35).finished()};
  const Matrix3d rotation = CayleyRotation(Vector3d(0.4, -1.1, 0.7));
  const Matrix3d frame =
      rotation * (Matrix3d::Identity() + StrainMatrix(d.strain));
  Matrix3d s = compliance.Between(g, h);
  for (int axis = 0; axis < 3; ++axis) {
    s += d.turn(axis) * compliance.OfTurn(g, h, axis);
  }
  for (int k = 0; k < 6; ++k) {
    s += d.strain(k) * compliance.OfStrain(g, h, k);
  }
  const Matrix3d exact = ExactCompliance(body, d, rotation, g, h);
  return (frame * s * frame.transpose() - exact).norm() / exact.norm();
}

class JointComplianceTest : public testing::Test {
 protected:
  const Vector4d right_{1.0, 1.5, 0.2, -0.3};
  const Vector4d left_{1.0, -1.4, 0.1, 0.4};
};

// (EM-17): a tenth of the deviation leaves a hundredth of the error.
TEST_F(JointComplianceTest, IsRightToFirstOrder) {
  for (const auto& [g, h] : {std::pair(right_, right_), std::pair(left_, left_),
                             std::pair(right_, left_)}) {
    // A third order is 1e-4 of that; rounding is 1e-13 of 1e-10.
    EXPECT_NEAR(std::log10(Error(1e-4, g, h) / Error(1e-5, g, h)), 2.0, 0.01);
  }
}

TEST_F(JointComplianceTest, WithoutDeviationIsExact) {
  // γ of the 9×9 inverse (3 · 9 · 9 operations) times its condition: stiffness
  // ¼ Δt² b = 1500 kg m² beside moments of 1350 to 12150, so at most 16.
  EXPECT_LT(Error(0.0, right_, left_), RoundoffBound(243, 16.0));
}

TEST_F(JointComplianceTest, ATurnIsOddUnderExchangeAndAStrainEven) {
  const JointCompliance compliance(Box(), kTimeStep);
  for (int axis = 0; axis < 3; ++axis) {
    const Matrix3d of_turn = compliance.OfTurn(right_, left_, axis);
    EXPECT_LT(
        (of_turn + compliance.OfTurn(left_, right_, axis).transpose()).norm(),
        RoundoffBound(30, of_turn.norm()));
  }
  for (int k = 0; k < 6; ++k) {
    const Matrix3d of_strain = compliance.OfStrain(right_, left_, k);
    EXPECT_LT(
        (of_strain - compliance.OfStrain(left_, right_, k).transpose()).norm(),
        RoundoffBound(30, of_strain.norm()));
  }
}

}  // namespace
}  // namespace emmy
