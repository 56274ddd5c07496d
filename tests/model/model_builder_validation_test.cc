// Every message of BuildModel, in full: it is what a person sees who made the
// mistake.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <variant>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"

namespace emmy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TensorInertia Inertia() {
  return {.mass = 10.0,
          .tensor = Vector3d(2.0, 3.0, 4.0).asDiagonal(),
          .volume = 0.5};
}

void SetTensor(RigidBodyDescription& body, int row, int column, double value) {
  TensorInertia inertia = Inertia();
  inertia.tensor(row, column) = value;
  body.inertia = inertia;
}

void SetPenalty(RigidBodyDescription& body, size_t entry, double value) {
  std::array<double, 6> penalty{};
  penalty.fill(1e10);
  penalty[entry] = value;
  body.penalty = penalty;
}

// What is done to the paper's box, and the message it earns, which begins with
// /rigid_bodies/0/.
struct Mistake {
  const char* name;
  std::function<void(RigidBodyDescription&)> make;
  const char* message;
  friend void PrintTo(const Mistake& m, std::ostream* os) { *os << m.name; }
};

class BodyMistakeTest : public ::testing::TestWithParam<Mistake> {};

TEST_P(BodyMistakeTest, IsRejectedWithPlaceExpectationUnitAndValue) {
  RigidBodyDescription body = PaperBox();
  GetParam().make(body);
  const auto built = BuildModel(ModelOf(body));
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(built.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(std::string(built.status().message()),
            std::string("/rigid_bodies/0/") + GetParam().message);
}

// The place is counted over all bodies, not from the first.
TEST_P(BodyMistakeTest, OfALaterBodyIsReportedThere) {
  ModelDescription description = ModelOf(PaperBox());
  RigidBodyDescription body = PaperBox();
  body.name = "second";
  GetParam().make(body);
  description.rigid_bodies.push_back(body);
  const auto built = BuildModel(description);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(std::string(built.status().message()),
            std::string("/rigid_bodies/1/") + GetParam().message);
}

using Body = RigidBodyDescription;

INSTANTIATE_TEST_SUITE_P(
    Box, BodyMistakeTest,
    ::testing::Values(
        Mistake{"EmptyName", [](Body& b) { b.name.clear(); },
                "name: must be a name that is not empty, got \"\""},
        Mistake{
            "NegativeDensity",
            [](Body& b) { std::get<BoxInertia>(b.inertia).density = -2700; },
            "box/density: must be a finite number > 0 [kg/m^3], got "
            "-2700"},
        Mistake{"ZeroDensity",
                [](Body& b) { std::get<BoxInertia>(b.inertia).density = 0; },
                "box/density: must be a finite number > 0 [kg/m^3], got 0"},
        Mistake{"NotANumberDensity",
                [](Body& b) { std::get<BoxInertia>(b.inertia).density = kNan; },
                "box/density: must be a finite number > 0 [kg/m^3], got nan"},
        Mistake{"InfiniteDensity",
                [](Body& b) {
                  std::get<BoxInertia>(b.inertia).density = kInfinity;
                },
                "box/density: must be a finite number > 0 [kg/m^3], got inf"},
        Mistake{"ZeroLength",
                [](Body& b) { std::get<BoxInertia>(b.inertia).size(0) = 0; },
                "box/size/0: must be a finite number > 0 [m], got 0"},
        Mistake{"NegativeWidth",
                [](Body& b) { std::get<BoxInertia>(b.inertia).size(1) = -0.5; },
                "box/size/1: must be a finite number > 0 [m], got -0.5"},
        Mistake{"InfiniteHeight",
                [](Body& b) {
                  std::get<BoxInertia>(b.inertia).size(2) = kInfinity;
                },
                "box/size/2: must be a finite number > 0 [m], got inf"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Tensor, BodyMistakeTest,
    ::testing::Values(
        Mistake{"ZeroMass",
                [](Body& b) {
                  TensorInertia inertia = Inertia();
                  inertia.mass = 0.0;
                  b.inertia = inertia;
                },
                "inertia/mass: must be a finite number > 0 [kg], got 0"},
        Mistake{"NotANumberVolume",
                [](Body& b) {
                  TensorInertia inertia = Inertia();
                  inertia.volume = kNan;
                  b.inertia = inertia;
                },
                "inertia/volume: must be a finite number > 0 [m^3], got nan"},
        Mistake{"Asymmetric", [](Body& b) { SetTensor(b, 1, 0, 0.25); },
                "inertia/tensor/1/0: must be equal to its mirror entry 0/1 "
                "(the tensor is symmetric) [kg m^2], got 0.25 and 0"},
        Mistake{"NotANumberEntry", [](Body& b) { SetTensor(b, 2, 1, kNan); },
                "inertia/tensor/2/1: must be a finite number [kg m^2], got "
                "nan"},
        Mistake{"TooLargeMoment", [](Body& b) { SetTensor(b, 2, 2, 6.0); },
                "inertia/tensor: second moments tr(J)/2 - J must be positive "
                "definite [kg m^2], got the principal values (-0.5, 2.5, 3.5)"},
        Mistake{"NegativeMoment", [](Body& b) { SetTensor(b, 0, 0, -2.0); },
                "inertia/tensor: second moments tr(J)/2 - J must be positive "
                "definite [kg m^2], got the principal values (-1.5, -0.5, "
                "4.5)"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Penalty, BodyMistakeTest,
    ::testing::Values(
        Mistake{"Missing", [](Body& b) { b.penalty = std::monostate(); },
                "penalty: must be given for an ancf body, one number or six "
                "[Pa], got nothing"},
        Mistake{"Zero", [](Body& b) { b.penalty = 0.0; },
                "penalty: must be a finite number > 0 [Pa], got 0"},
        Mistake{"Negative", [](Body& b) { b.penalty = -1e10; },
                "penalty: must be a finite number > 0 [Pa], got -1e+10"},
        Mistake{"Infinite", [](Body& b) { b.penalty = kInfinity; },
                "penalty: must be a finite number > 0 [Pa], got inf"},
        Mistake{"FirstOfSixZero", [](Body& b) { SetPenalty(b, 0, 0.0); },
                "penalty/0: must be a finite number > 0 [Pa], got 0"},
        Mistake{"LastOfSixNotANumber", [](Body& b) { SetPenalty(b, 5, kNan); },
                "penalty/5: must be a finite number > 0 [Pa], got nan"},
        Mistake{"OfAConventionalBody",
                [](Body& b) { b.formulation = Formulation::kConventional; },
                "penalty: not allowed for a conventional body"}),
    [](const auto& mistake) { return mistake.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Start, BodyMistakeTest,
    ::testing::Values(
        Mistake{"ZeroQuaternion",
                [](Body& b) {
                  b.orientation = Quaternion{0, 0, 0, 0};
                },
                "orientation/quaternion: must be a quaternion [w, x, y, z] "
                "that is not zero, got [0, 0, 0, 0]"},
        Mistake{
            "InfiniteQuaternion",
            [](Body& b) { b.orientation = Quaternion{.w = 1, .z = kInfinity}; },
            "orientation/quaternion/3: must be a finite number, got inf"},
        Mistake{"NotANumberRotationVector",
                [](Body& b) {
                  b.orientation = RotationVector{{0.0, kNan, 0.0}};
                },
                "orientation/rotation_vector/1: must be a finite number "
                "[rad], got nan"},
        Mistake{"InfinitePosition", [](Body& b) { b.position(2) = -kInfinity; },
                "position/2: must be a finite number [m], got -inf"},
        Mistake{"NotANumberVelocity", [](Body& b) { b.velocity(0) = kNan; },
                "velocity/0: must be a finite number [m/s], got nan"},
        Mistake{"InfiniteAngularVelocity",
                [](Body& b) { b.angular_velocity(1) = kInfinity; },
                "angular_velocity/1: must be a finite number [rad/s], got "
                "inf"},
        Mistake{"InfiniteAngularVelocityInBodyAxes",
                [](Body& b) {
                  b.angular_velocity_in_body_axes = true;
                  b.angular_velocity(1) = kInfinity;
                },
                "angular_velocity_body/1: must be a finite number [rad/s], "
                "got inf"},
        Mistake{"RelaxedConventional",
                [](Body& b) {
                  b = PaperBox(Formulation::kConventional);
                  b.name = "other";
                  b.start = Start::kRelaxed;
                },
                "start: must be \"undeformed\" for a conventional body, got "
                "\"relaxed\""},
        Mistake{"RelaxedTooSoft",
                [](Body& b) {
                  b.start = Start::kRelaxed;
                  b.penalty = 1000.0;
                },
                "start: a relaxed start needs strains below 0.4, got up to "
                "1.94; raise the penalty or start undeformed"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(ModelMistakeTest, NoBodiesIsRejected) {
  const auto built = BuildModel({});
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(built.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(std::string(built.status().message()),
            "/rigid_bodies: must hold at least one body, or /nodes one node, "
            "got none");
}

TEST(ModelMistakeTest, InfiniteGravityIsRejected) {
  ModelDescription description = ModelOf(PaperBox());
  description.gravity(2) = -kInfinity;
  const auto built = BuildModel(description);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(std::string(built.status().message()),
            "/gravity/2: must be a finite number [m/s^2], got -inf");
}

TEST(ModelMistakeTest, ANameGivenTwiceIsRejectedAndBothPlacesNamed) {
  ModelDescription description = ModelOf(PaperBox());
  RigidBodyDescription other = PaperBox();
  other.name = "other";
  description.rigid_bodies.push_back(other);
  description.rigid_bodies.push_back(PaperBox());
  const auto built = BuildModel(description);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(std::string(built.status().message()),
            "/rigid_bodies/2/name: must be unique, got \"box\", which is the "
            "name of /rigid_bodies/0");
}

TEST(ModelMistakeTest, NothingIsRejectedInThePaperBox) {
  EXPECT_TRUE(BuildModel(ModelOf(PaperBox())).ok());
  EXPECT_TRUE(BuildModel(ModelOf(PaperBox(Formulation::kConventional))).ok());
  RigidBodyDescription body = PaperBox();
  body.inertia = Inertia();
  EXPECT_TRUE(BuildModel(ModelOf(body)).ok());
}

}  // namespace
}  // namespace emmy
