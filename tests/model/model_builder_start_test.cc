// The first state: exact beyond a double, since whatever it lacks no step can
// give back.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <ostream>
#include <variant>

#include "emmy/element/relaxed_start.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kTrials = 50;

// Some 30 extended operations of up to 15 u².
constexpr double kExtendedBound = 450.0 * kUnitRoundoff * kUnitRoundoff;

WideMatrix3 Rotation(const Quaternion& quaternion) {
  Eigen::Quaternion<Wide> q(quaternion.w, quaternion.x, quaternion.y,
                            quaternion.z);
  q.coeffs() /= sqrt(Wide(q.coeffs().dot(q.coeffs())));
  return q.toRotationMatrix();
}

struct Length {
  const char* name;
  double length;  // Of the quaternion given.
  // How well its direction is kept: where its square would leave the range of
  // a double it is scaled first, which rounds every entry once.
  double accuracy = kExtendedBound;
  friend void PrintTo(const Length& l, std::ostream* os) { *os << l.name; }
};

class BuiltStartTest : public ::testing::TestWithParam<Length> {
 protected:
  RigidBodyDescription RandomBox(Formulation formulation) {
    RigidBodyDescription body = PaperBox(formulation);
    const Vector4d q = GetParam().length * random_.UnitQuaternion();
    body.orientation = Quaternion{q(0), q(1), q(2), q(3)};
    body.angular_velocity = random_.Vector(2.0);
    body.position = random_.Vector(100.0);
    body.velocity = random_.Vector(10.0);
    return body;
  }
  static WideMatrix3 Attitude(const RigidBodyDescription& body) {
    return Rotation(std::get<Quaternion>(body.orientation));
  }

  RandomSource random_{20250401};
};

TEST_P(BuiltStartTest, GradientVectorsAreTheRotationToThirtyDigits) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidBodyDescription body = RandomBox(Formulation::kAncf);
    const State state = BuildModel(ModelOf(body))->state;
    const WideMatrix3 e = ToWideColumns(state.position, 3);
    EXPECT_LE(MaxAbs(e.transpose() * e - WideMatrix3::Identity()), 1e-30);
    EXPECT_LE(MaxAbs(e - Attitude(body)), GetParam().accuracy);
    EXPECT_EQ(state.strain.value, VectorXd(Vector6d::Zero()));
  }
}

TEST_P(BuiltStartTest, RatesAreAngularVelocityTimesGradientVectors) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidBodyDescription body = RandomBox(Formulation::kAncf);
    const State state = BuildModel(ModelOf(body))->state;
    const WideMatrix3 e = ToWideColumns(state.position, 3);
    const WideMatrix3 w = ToWideColumns(state.velocity, 3);
    const WideVector3 omega = body.angular_velocity.cast<Wide>();
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(MaxAbs(w.col(i) - omega.cross(e.col(i))),
                kExtendedBound * body.angular_velocity.norm());
    }
  }
}

TEST_P(BuiltStartTest, ConventionalQuaternionIsAUnitToThirtyDigits) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidBodyDescription body = RandomBox(Formulation::kConventional);
    const State state = BuildModel(ModelOf(body))->state;
    const auto q = ToWide<4>(state.position, 3);
    EXPECT_LE(std::abs(ToDouble(q.dot(q) - 1)), kExtendedBound);
    // W = Rᵀω
    const WideVector3 omega =
        Attitude(body).transpose() * body.angular_velocity.cast<Wide>();
    EXPECT_LE(MaxAbs(ToWide<3>(state.velocity, 3) - omega),
              GetParam().accuracy * body.angular_velocity.norm());
  }
}

TEST_P(BuiltStartTest, BodyAxesOfTheAngularVelocityTurnWithTheBody) {
  for (int trial = 0; trial < kTrials; ++trial) {
    RigidBodyDescription body = RandomBox(Formulation::kAncf);
    body.angular_velocity_in_body_axes = true;
    const State state = BuildModel(ModelOf(body))->state;
    const WideMatrix3 e = ToWideColumns(state.position, 3);
    const WideVector3 omega = e * body.angular_velocity.cast<Wide>();
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(MaxAbs(WideVector3(ToWideColumns(state.velocity, 3).col(i)) -
                       omega.cross(WideVector3(e.col(i)))),
                3.0 * kExtendedBound * body.angular_velocity.norm());
    }
    body.formulation = Formulation::kConventional;
    body.penalty = std::monostate();
    const State conventional = BuildModel(ModelOf(body))->state;
    EXPECT_EQ(Vector3d(conventional.velocity.value.segment<3>(3)),
              body.angular_velocity);
  }
}

TEST_P(BuiltStartTest, PositionAndVelocityAreThoseGiven) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    const RigidBodyDescription body = RandomBox(formulation);
    const State state = BuildModel(ModelOf(body))->state;
    EXPECT_EQ(Vector3d(state.position.value.head<3>()), body.position);
    EXPECT_EQ(Vector3d(state.velocity.value.head<3>()), body.velocity);
    EXPECT_EQ(state.time.value, 0.0);
    EXPECT_EQ(state.step, 0);
  }
}

// A start without strain error: what the coordinates have is what is carried.
TEST_P(BuiltStartTest, RelaxedVectorsHaveTheStrainThatIsCarried) {
  for (int trial = 0; trial < kTrials; ++trial) {
    RigidBodyDescription body = RandomBox(Formulation::kAncf);
    body.penalty = 1e6;
    body.start = Start::kRelaxed;
    const auto built = BuildModel(ModelOf(body));
    ASSERT_TRUE(built.ok()) << built.status();
    const Vector6d strain = built->state.strain.value;
    const WideMatrix3 e = ToWideColumns(built->state.position, 3);
    for (int i = 0; i < 3; ++i) {
      const Wide normal = (Wide(e.col(i).dot(e.col(i))) - 1) / 2;
      const Wide shear = e.col(i).dot(e.col((i + 1) % 3));
      EXPECT_LE(std::abs(ToDouble(normal - strain(i))), 4.0 * kExtendedBound);
      EXPECT_LE(std::abs(ToDouble(shear - strain(3 + i))),
                4.0 * kExtendedBound);
    }
    const Vector3d omega_body =
        (Attitude(body).transpose() * body.angular_velocity.cast<Wide>())
            .cast<double>();
    const Vector6d expected =
        RelaxedStrain(*built->model.bodies()[0].ancf(), omega_body);
    // ω in body axes is rounded once more here.
    EXPECT_LE((strain - expected).cwiseAbs().maxCoeff(),
              RoundoffBound(40, expected.cwiseAbs().maxCoeff()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Quaternions, BuiltStartTest,
    ::testing::Values(Length{"Unit", 1.0}, Length{"Long", 12345.678},
                      Length{"Tiny", 1e-200, RoundoffBound(8, 1.0)},
                      Length{"Huge", 1e200, RoundoffBound(8, 1.0)},
                      Length{"Subnormal", 1e-310, RoundoffBound(8, 1.0)},
                      Length{"Least", 5e-324, RoundoffBound(8, 1.0)}),
    [](const auto& length) { return length.param.name; });

// The checks of orthonormality see the start that an ordinary double gives.
TEST(BuiltStartPrecisionTest, WithoutCompensationsVectorsAreNotOrthonormal) {
  RigidBodyDescription body = PaperBox();
  body.orientation = RotationVector{{0.3, -0.4, 1.2}};
  State state = BuildModel(ModelOf(body))->state;
  state.position.compensation.setZero();
  const WideMatrix3 e = ToWideColumns(state.position, 3);
  EXPECT_GT(MaxAbs(e.transpose() * e - WideMatrix3::Identity()), 1e-18);
}

TEST(BuiltStartOrientationTest, RotationVectorTurnsByItsLength) {
  RigidBodyDescription body = PaperBox();
  body.orientation = RotationVector{{0.0, 0.0, 0.5}};
  const State state = BuildModel(ModelOf(body))->state;
  EXPECT_NEAR(state.position.value(3), std::cos(0.5), RoundoffBound(8, 1.0));
  EXPECT_NEAR(state.position.value(4), std::sin(0.5), RoundoffBound(8, 1.0));
  EXPECT_EQ(state.position.value(5), 0.0);
}

TEST(BuiltLayoutTest, BodiesFollowEachOtherInTheState) {
  ModelDescription description = ModelOf(PaperBox());
  RigidBodyDescription conventional = PaperBox(Formulation::kConventional);
  conventional.name = "comparator";
  description.rigid_bodies.push_back(conventional);
  RigidBodyDescription third = PaperBox();
  third.name = "third";
  description.rigid_bodies.push_back(third);
  const auto built = BuildModel(description);
  ASSERT_TRUE(built.ok()) << built.status();
  const Model& model = built->model;
  ASSERT_EQ(model.bodies().size(), 3U);
  EXPECT_EQ(model.bodies()[1].name, "comparator");
  EXPECT_NE(model.bodies()[0].ancf(), nullptr);
  EXPECT_NE(model.bodies()[1].conventional(), nullptr);
  EXPECT_EQ(model.bodies()[1].position_offset, 12);
  EXPECT_EQ(model.bodies()[2].position_offset, 19);
  EXPECT_EQ(model.bodies()[2].velocity_offset, 18);
  EXPECT_EQ(model.bodies()[2].strain_offset, 6);
  EXPECT_EQ(model.num_positions(), 31);
  EXPECT_EQ(model.num_velocities(), 30);
  EXPECT_EQ(model.num_strains(), 12);
  EXPECT_EQ(model.degrees_of_freedom(), 30);
  EXPECT_EQ(built->state.position.value.size(), 31);
}

TEST(BuiltModelTest, OnePenaltyCountsForAllSixStrains) {
  std::array<double, 6> six{};
  six.fill(1e8);
  RigidBodyDescription body = PaperBox(Formulation::kAncf, 1e8);
  const auto one = BuildModel(ModelOf(body));
  body.penalty = six;
  const auto all = BuildModel(ModelOf(body));
  EXPECT_EQ(one->model.bodies()[0].ancf()->penalty_stiffness(),
            all->model.bodies()[0].ancf()->penalty_stiffness());
}

}  // namespace
}  // namespace emmy
