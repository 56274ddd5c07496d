// What is wrong with a case is said with place, expectation, unit and value.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "emmy/io/case_file.h"
#include "tests/io/sample_case.h"

namespace emmy {
namespace {

struct Mistake {
  const char* name;
  const char* setting;  // Turns the sample case into one with the mistake.
  const char* message;
  friend void PrintTo(const Mistake& m, std::ostream* os) { *os << m.name; }
};

class CaseStructureTest : public ::testing::TestWithParam<Mistake> {};

TEST_P(CaseStructureTest, NamesPlaceExpectationAndValue) {
  const absl::StatusOr<Case> result =
      ParseCase(kSampleCase, {GetParam().setting});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(result.status().message(), GetParam().message);
}

std::string Name(const ::testing::TestParamInfo<Mistake>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, CaseStructureTest,
    ::testing::Values(
        Mistake{"UnknownKeyInTheCase", "/integrater={}",
                "/integrater: unknown key, expected one of: format, name, "
                "integrator, purpose, gravity, rigid_bodies, nodes, trusses, "
                "springs, shared_points, loads, output (did you mean "
                "integrator?)"},
        Mistake{"UnknownKeyWithoutANearOne", "/output/colour=1",
                "/output/colour: unknown key, expected one of: every"},
        Mistake{"UnknownKeyInABox", "/rigid_bodies/0/box/densty=1",
                "/rigid_bodies/0/box/densty: unknown key, expected one of: "
                "size, density (did you mean density?)"},
        Mistake{"KeyInTheWrongCase", "/output/Every=1",
                "/output/Every: unknown key, expected one of: every (did you "
                "mean every?)"},
        Mistake{"MissingKey", R"(/integrator={"method": "energy_momentum",
                "duration": 1})",
                "/integrator/time_step: required key is missing"},
        Mistake{"MissingKeyInANode", R"(/nodes/0={"name": "tip"})",
                "/nodes/0/mass: required key is missing"},
        Mistake{"NeitherBoxNorInertia", R"(/rigid_bodies/0={"name": "box"})",
                "/rigid_bodies/0: must have one of the keys \"box\", "
                "\"inertia\", got none of them"},
        Mistake{"BoxAndInertia", "/rigid_bodies/0/inertia={}",
                "/rigid_bodies/0: must have only one of the keys \"box\", "
                "\"inertia\", got \"box\" and \"inertia\""},
        Mistake{"TwoAngularVelocities",
                "/rigid_bodies/0/angular_velocity_body=[0,0,0]",
                "/rigid_bodies/0: must have only one of the keys "
                "\"angular_velocity\", \"angular_velocity_body\", got "
                "\"angular_velocity\" and \"angular_velocity_body\""},
        Mistake{"EmptyOrientation", "/rigid_bodies/0/orientation={}",
                "/rigid_bodies/0/orientation: must have one of the keys "
                "\"quaternion\", \"rotation_vector\", got none of them"},
        Mistake{"EmptyPoint", "/trusses/0/ends/1={}",
                "/trusses/0/ends/1: must have one of the keys \"body\", "
                "\"node\", \"ground\", got none of them"},
        Mistake{"PointOfTwoKinds", "/trusses/0/ends/1/body=box",
                "/trusses/0/ends/1: must have only one of the keys \"body\", "
                "\"node\", \"ground\", got \"body\" and \"node\""},
        Mistake{"BodyPointWithoutPoint", R"(/trusses/0/ends/0={"body":"box"})",
                "/trusses/0/ends/0/point: required key is missing"},
        Mistake{"NodePointWithPoint", "/trusses/0/ends/1/point=[0,0,0]",
                "/trusses/0/ends/1/point: unknown key, expected one of: node"},
        Mistake{"LoadOfNoKind", R"(/loads/0={"point": {"node": "ball"}})",
                "/loads/0: must have one of the keys \"force\", \"torque\", "
                "got none of them"},
        Mistake{"TorqueOnAPoint",
                R"(/loads/0={"point": {"node": "ball"}, "torque": [0,0,1]})",
                "/loads/0/point: unknown key, expected one of: body, torque"}),
    Name);

INSTANTIATE_TEST_SUITE_P(
    Types, CaseStructureTest,
    ::testing::Values(
        Mistake{"Format", "/format=emmy-case/2",
                "/format: must be \"emmy-case/1\", got \"emmy-case/2\""},
        Mistake{"EmptyName",
                "/name=", "/name: must be a name that is not empty, got \"\""},
        Mistake{"NumberAsName", "/rigid_bodies/0/name=7",
                "/rigid_bodies/0/name: must be a name that is not empty, got "
                "7"},
        Mistake{"ObjectAsList", "/rigid_bodies={}",
                "/rigid_bodies: must be an array, got {}"},
        Mistake{"NumberAsBody", "/rigid_bodies/0=1",
                "/rigid_bodies/0: must be an object, got 1"},
        Mistake{"NullAsNumber", "/rigid_bodies/0/box/density=null",
                "/rigid_bodies/0/box/density: must be a finite number > 0 "
                "[kg/m^3], got null"},
        Mistake{"TextAsNumber", "/rigid_bodies/0/box/density=nan",
                "/rigid_bodies/0/box/density: must be a finite number > 0 "
                "[kg/m^3], got \"nan\""},
        Mistake{"OverflowAsNumber", "/integrator/time_step=1e999",
                "/integrator/time_step: must be a finite number > 0 [s], got "
                "\"1e999\""},
        Mistake{"VectorOfTwo", "/gravity=[0,0]",
                "/gravity: must be three finite numbers [m/s^2], got [0,0]"},
        Mistake{"VectorWithText", R"(/nodes/0/position=[0,"0",0])",
                "/nodes/0/position/1: must be a finite number [m], got \"0\""},
        Mistake{"LongVector", "/gravity=[1,2,3,4,5,6,7,8,9,10]",
                "/gravity: must be three finite numbers [m/s^2], got an array "
                "of 10"},
        Mistake{"QuaternionOfThree",
                "/rigid_bodies/0/orientation/quaternion=[1,0,0]",
                "/rigid_bodies/0/orientation/quaternion: must be four finite "
                "numbers [w, x, y, z], not all zero, got [1,0,0]"},
        Mistake{"PenaltyOfFive", "/rigid_bodies/0/penalty=[1,1,1,1,1]",
                "/rigid_bodies/0/penalty: must be a finite number > 0 or six "
                "of them [Pa], got [1,1,1,1,1]"},
        Mistake{"TensorOfTwo", "/rigid_bodies/1/inertia/tensor=[1,1]",
                "/rigid_bodies/1/inertia/tensor: must be [Jx, Jy, Jz] or a "
                "symmetric 3x3 matrix [kg m^2], got [1,1]"},
        Mistake{"TensorWithAShortRow",
                "/rigid_bodies/1/inertia/tensor=[[1,0,0],[0,1],[0,0,1]]",
                "/rigid_bodies/1/inertia/tensor/1: must be three finite "
                "numbers [kg m^2], got [0,1]"},
        Mistake{"UnknownFormulation", "/rigid_bodies/0/formulation=affine",
                "/rigid_bodies/0/formulation: must be \"ancf\" or "
                "\"conventional\", got \"affine\""},
        Mistake{"UnknownStart", "/rigid_bodies/0/start=rest",
                "/rigid_bodies/0/start: must be \"undeformed\" or "
                "\"relaxed\", got \"rest\""},
        Mistake{"NumberAsSwitch", "/nodes/0/fixed=1",
                "/nodes/0/fixed: must be true or false, got 1"},
        Mistake{"OneEnd", R"(/trusses/0/ends=[{"node":"tip"}])",
                "/trusses/0/ends: must be an array of two points, got an array "
                "of 1"},
        Mistake{"ThreeSharedPoints",
                R"(/shared_points/0=[{"node":"tip"},{"node":"tip"},7])",
                "/shared_points/0: must be an array of two points, got an "
                "array of 3"},
        Mistake{"VelocityAsText", "/nodes/0/velocity=fast",
                "/nodes/0/velocity: must be three finite numbers [m/s] or "
                "{\"moves_with\": BODY}, got \"fast\""}),
    Name);

INSTANTIATE_TEST_SUITE_P(
    Integrator, CaseStructureTest,
    ::testing::Values(
        Mistake{"UnknownMethod", "/integrator/method=euler",
                "/integrator/method: must be \"energy_momentum\", got "
                "\"euler\""},
        Mistake{"OddOrder", "/integrator/order=3",
                "/integrator/order: must be 2, 4 or 6, got 3"},
        Mistake{"OrderWithAFraction", "/integrator/order=2.5",
                "/integrator/order: must be 2, 4 or 6, got 2.5"},
        Mistake{"HugeOrder", "/integrator/order=1e300",
                "/integrator/order: must be 2, 4 or 6, got 1e+300"},
        Mistake{"ZeroStep", "/integrator/time_step=0",
                "/integrator/time_step: must be a finite number > 0 [s], got "
                "0"},
        Mistake{"NegativeStep", "/integrator/time_step=-0.001",
                "/integrator/time_step: must be a finite number > 0 [s], got "
                "-0.001"},
        Mistake{"ZeroDuration", "/integrator/duration=0",
                "/integrator/duration: must be a finite number > 0 [s], got "
                "0"},
        Mistake{"TooManySteps", "/integrator/duration=1e300",
                "/integrator/duration: must be at most 2^53 time steps, got "
                "1e+300"},
        Mistake{"ToleranceOfOne", "/integrator/tolerance=1",
                "/integrator/tolerance: must be \"round_off\" or a relative "
                "number in (0, 1) [-], got 1"},
        Mistake{"MisspeltTolerance", "/integrator/tolerance=roundoff",
                "/integrator/tolerance: must be \"round_off\" or a relative "
                "number in (0, 1) [-], got \"roundoff\""},
        Mistake{"WriteEveryZero", "/output/every=0",
                "/output/every: must be a whole number >= 1 [steps], got 0"},
        Mistake{"WriteEveryHalf", "/output/every=0.5",
                "/output/every: must be a whole number >= 1 [steps], got "
                "0.5"}),
    Name);

TEST(CaseErrorTest, ADocumentThatIsNotAnObjectIsShown) {
  EXPECT_EQ(ParseCase("[1]").status().message(), "must be an object, got [1]");
}

TEST(CaseErrorTest, AFileOfAnotherFormatIsCalledThatBeforeItsKeysAre) {
  EXPECT_EQ(ParseCase(R"({"format": "other/1", "key": 1})").status().message(),
            "/format: must be \"emmy-case/1\", got \"other/1\"");
}

TEST(CaseErrorTest, ALongValueIsShortened) {
  const absl::StatusOr<Case> result =
      ParseCase(kSampleCase, {"/format=" + std::string(100000, 'x')});
  EXPECT_LT(result.status().message().size(), 120u);
}

}  // namespace
}  // namespace emmy
