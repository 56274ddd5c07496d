#include "emmy/element/rigid_body_inertia.h"

#include <gtest/gtest.h>

#include "emmy/numerics/rotation.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {
namespace {

// (ANCF-3), both ways.
void ExpectMomentsAndTensorAgree(const RigidBodyInertia& inertia) {
  const Matrix3d& m = inertia.second_moment;
  const Matrix3d& j = inertia.tensor;
  const double bound = RoundoffBound(8, j.cwiseAbs().maxCoeff());
  const Matrix3d one = Matrix3d::Identity();
  EXPECT_LE((m.trace() * one - m - j).cwiseAbs().maxCoeff(), bound);
  EXPECT_LE((0.5 * j.trace() * one - j - m).cwiseAbs().maxCoeff(), bound);
}

TEST(RigidBodyInertiaTest, PaperBoxHasTheMomentsOfThePaper) {
  const RigidBodyInertia box = PaperBoxInertia();
  EXPECT_EQ(box.volume, 6.0);
  EXPECT_EQ(box.mass, 16200.0);
  EXPECT_EQ(box.second_moment,
            Matrix3d(Vector3d(12150.0, 5400.0, 1350.0).asDiagonal()));
  EXPECT_EQ(box.tensor,
            Matrix3d(Vector3d(6750.0, 13500.0, 17550.0).asDiagonal()));
}

TEST(RigidBodyInertiaTest, BoxMomentsAndTensorAgree) {
  RandomSource random(20250321);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3d size =
        random.Vector(1.0).cwiseAbs() + Vector3d::Constant(0.01);
    ExpectMomentsAndTensorAgree(RigidBodyInertia::Box(size, 1000.0));
  }
}

TEST(RigidBodyInertiaTest, TensorMomentsAndTensorAgreeInAnyAxes) {
  RandomSource random(20250322);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3d r = QuaternionToMatrix(random.UnitQuaternion());
    const Matrix3d product =
        r * Vector3d(2.0, 3.0, 4.0).asDiagonal() * r.transpose();
    const Matrix3d tensor = 0.5 * (product + product.transpose());
    const auto inertia = RigidBodyInertia::FromTensor(5.0, tensor, 0.25);
    ASSERT_TRUE(inertia.ok()) << inertia.status();
    EXPECT_EQ(inertia->mass, 5.0);
    EXPECT_EQ(inertia->volume, 0.25);
    EXPECT_EQ(inertia->tensor, tensor);
    ExpectMomentsAndTensorAgree(*inertia);
  }
}

TEST(RigidBodyInertiaTest, BoxAndItsTensorGiveTheSameMoments) {
  const RigidBodyInertia box = PaperBoxInertia();
  const auto inertia =
      RigidBodyInertia::FromTensor(box.mass, box.tensor, box.volume);
  ASSERT_TRUE(inertia.ok());
  EXPECT_EQ(inertia->second_moment, box.second_moment);
}

TEST(RigidBodyInertiaTest, RejectsATensorThatNoSolidBodyHas) {
  const auto inertia = RigidBodyInertia::FromTensor(
      1.0, Vector3d(1.0, 2.0, 4.0).asDiagonal(), 1.0);
  ASSERT_FALSE(inertia.ok());
  EXPECT_EQ(inertia.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(inertia.status().message(),
            "second moments tr(J)/2 - J must be positive definite [kg m^2], "
            "got the principal values (-0.5, 1.5, 2.5)");
}

// A plane plate has M³³ = 0; its penalty body would have no mass there.
TEST(RigidBodyInertiaTest, RejectsAPlaneBody) {
  const auto plate = RigidBodyInertia::FromTensor(
      1.0, Vector3d(1.0, 2.0, 3.0).asDiagonal(), 1.0);
  ASSERT_FALSE(plate.ok());
  EXPECT_EQ(plate.status().message(),
            "second moments tr(J)/2 - J must be positive definite [kg m^2], "
            "got the principal values (0, 1, 2)");
}

// The zero moment of a tilted plate is rounding, of either sign.
TEST(RigidBodyInertiaTest, RejectsATiltedPlaneBody) {
  RandomSource random(20250323);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3d r = QuaternionToMatrix(random.UnitQuaternion());
    const Matrix3d product =
        r * Vector3d(1.0, 2.0, 3.0).asDiagonal() * r.transpose();
    EXPECT_FALSE(RigidBodyInertia::FromTensor(
                     1.0, 0.5 * (product + product.transpose()), 1.0)
                     .ok())
        << "trial " << trial;
  }
}

TEST(RigidBodyInertiaTest, AcceptsAThinPlate) {
  const RigidBodyInertia box = RigidBodyInertia::Box({1.0, 1.0, 1e-5}, 1000.0);
  EXPECT_TRUE(
      RigidBodyInertia::FromTensor(box.mass, box.tensor, box.volume).ok());
}

}  // namespace
}  // namespace emmy
