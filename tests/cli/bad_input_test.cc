// Bad input: one line that names file, place, expectation and value; exit
// status 2; nothing written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/cli/program.h"

namespace emmy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

struct Mistake {
  const char* name;
  const char* from;  // What stands in the valid case,
  const char* to;    // and what it is replaced by.
  const char* message;
  friend void PrintTo(const Mistake& m, std::ostream* os) { *os << m.name; }
};

class BadCaseTest : public ProgramTest,
                    public ::testing::WithParamInterface<Mistake> {};

TEST_P(BadCaseTest, RunNamesTheMistakeAndWritesNothing) {
  Write("box.json", Replaced(kBoxCase, GetParam().from, GetParam().to));
  const ProgramResult result = Run("run box.json --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err, std::string(GetParam().message) + "\n");
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

TEST_P(BadCaseTest, CheckSaysTheSame) {
  Write("box.json", Replaced(kBoxCase, GetParam().from, GetParam().to));
  const ProgramResult result = Run("check box.json");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err, std::string(GetParam().message) + "\n");
  EXPECT_EQ(result.out, "");
}

constexpr char kGravity[] = R"("rigid_bodies": [)";  // To put a key before.
constexpr char kInertia[] = R"("box": {"size": [3, 2, 1], "density": 2700})";

std::string Name(const ::testing::TestParamInfo<Mistake>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Ranges, BadCaseTest,
    ::testing::Values(
        Mistake{"NegativeDensity", "2700", "-2700",
                "box.json: /rigid_bodies/0/box/density: must be a finite "
                "number > 0 [kg/m^3], got -2700"},
        Mistake{"ZeroDensity", "2700", "0",
                "box.json: /rigid_bodies/0/box/density: must be a finite "
                "number > 0 [kg/m^3], got 0"},
        Mistake{"NegativeSize", "[3, 2, 1]", "[3, -2, 1]",
                "box.json: /rigid_bodies/0/box/size/1: must be a finite "
                "number > 0 [m], got -2"},
        Mistake{"ZeroSize", "[3, 2, 1]", "[3, 2, 0]",
                "box.json: /rigid_bodies/0/box/size/2: must be a finite "
                "number > 0 [m], got 0"},
        Mistake{"NegativePenalty", "1e10", "-1e10",
                "box.json: /rigid_bodies/0/penalty: must be a finite number > "
                "0 [Pa], got -1e+10"},
        Mistake{"ZeroPenalty", "1e10", "0",
                "box.json: /rigid_bodies/0/penalty: must be a finite number > "
                "0 [Pa], got 0"},
        Mistake{"OneZeroPenaltyOfSix", "1e10", "[1, 1, 1, 1, 1, 0]",
                "box.json: /rigid_bodies/0/penalty/5: must be a finite number "
                "> 0 [Pa], got 0"},
        Mistake{"NegativeTimeStep", "1e-3", "-1e-3",
                "box.json: /integrator/time_step: must be a finite number > 0 "
                "[s], got -0.001"},
        Mistake{"ZeroTimeStep", "1e-3", "0",
                "box.json: /integrator/time_step: must be a finite number > 0 "
                "[s], got 0"},
        Mistake{"ZeroDuration", "1e-2", "0",
                "box.json: /integrator/duration: must be a finite number > 0 "
                "[s], got 0"},
        Mistake{"ZeroQuaternion", "[1, 0, 0, 0]", "[0, 0, 0, 0]",
                "box.json: /rigid_bodies/0/orientation/quaternion: must be a "
                "quaternion [w, x, y, z] that is not zero, got [0, 0, 0, 0]"},
        Mistake{"SecondMomentsNotPositiveDefinite", kInertia,
                R"("inertia": {"mass": 1, "tensor": [1, 1, 3], "volume": 1})",
                "box.json: /rigid_bodies/0/inertia/tensor: second moments "
                "tr(J)/2 - J must be positive definite [kg m^2], got the "
                "principal values (-0.5, 1.5, 1.5)"},
        Mistake{"FlatSecondMoments", kInertia,
                R"("inertia": {"mass": 1, "tensor": [1, 1, 2], "volume": 1})",
                "box.json: /rigid_bodies/0/inertia/tensor: second moments "
                "tr(J)/2 - J must be positive definite [kg m^2], got the "
                "principal values (0, 1, 1)"},
        Mistake{"SizesTooSmallTogether", "[3, 2, 1]", "[1e-120, 1e-120, 1]",
                "box.json: /rigid_bodies/0/box: must be a body with mass, "
                "volume and second moments >= 1e-90 [SI], got 2.7e-237 kg, "
                "1e-240 m^3 and 0 kg m^2"},
        Mistake{"ControlCharacterInAName", R"("name": "box",
      "box")",
                R"("name": "b\u0007\nx",
      "box")",
                "box.json: /rigid_bodies/0/name: must be a name without "
                "control characters, got \"b\\u0007\\u000ax\""},
        Mistake{"LaterControlCharacterInAName", R"("name": "box",
      "box")",
                R"("name": "é\u0085\u009bx",
      "box")",
                "box.json: /rigid_bodies/0/name: must be a name without "
                "control characters, got \"é\\u0085\\u009bx\""},
        Mistake{"NumbersTooLargeTogether", "[3, 2, 1]", "[3, 2e300, 1e300]",
                "box.json: /rigid_bodies/0/box: must be a body with finite "
                "mass, volume and second moments [SI], got inf kg, inf m^3 and "
                "inf kg m^2"},
        Mistake{"PenaltyTooLarge", "1e10", "1.7e308",
                "box.json: /rigid_bodies/0/penalty: must be so small that its "
                "product with the volume is a finite number [J], got 1.7e+308 "
                "Pa and 6 m^3"},
        Mistake{"VelocityTooLarge", "\"penalty\"",
                "\"velocity\": [0, 1e153, 0], \"penalty\"",
                "box.json: /rigid_bodies/0/velocity: must be so small that "
                "kinetic energy [J] and momentum [kg m/s] are finite numbers, "
                "got [0, 1e+153, 0] m/s"},
        Mistake{"AngularVelocityTooLarge", "[0.3, 0.5, 0.8]", "[0, 0, 1e153]",
                "box.json: /rigid_bodies/0/angular_velocity: must be so small "
                "that kinetic energy [J] and momentum [kg m/s] are finite "
                "numbers, got [0, 0, 1e+153] rad/s"},
        Mistake{"PositionTooLarge", "\"penalty\"",
                "\"position\": [1e200, 0, 0], \"velocity\": [0, 1e120, 0], "
                "\"penalty\"",
                "box.json: /rigid_bodies/0/position: must be so small that the "
                "angular momentum [kg m^2/s] is a finite number, got [1e+200, "
                "0, 0] m"},
        Mistake{"PositionTooLargeForGravity", kGravity,
                R"("gravity": [0, 0, 1e20], "nodes": [{"name": "n", "mass": 1,
                    "position": [0, 0, -1e290]}], "rigid_bodies": [)",
                "box.json: /nodes/0/position: must be so small that the "
                "gravity energy [J] is a finite number, got [0, 0, -1e+290] m"},
        Mistake{"RotationVectorTooLarge", R"({"quaternion": [1, 0, 0, 0]})",
                R"({"rotation_vector": [0, 1e155, 0]})",
                "box.json: /rigid_bodies/0/orientation/rotation_vector: must "
                "be an angle whose square is a finite number [rad], got "
                "1e+155"},
        Mistake{"TrussTooLong", kGravity,
                R"("nodes": [{"name": "n", "mass": 1,
                    "position": [0, 0, 1e155]}],
                   "trusses": [{"name": "t", "area": 1, "density": 0,
                    "young_modulus": 1, "ends": [{"ground": [9, 9, 9]},
                    {"node": "n"}]}], "rigid_bodies": [)",
                "box.json: /trusses/0/ends/1: must be a point whose distance "
                "from the other end has a finite square [m], got [0, 0, "
                "1e+155]"},
        Mistake{"TrussTooHeavy", kGravity,
                R"("nodes": [{"name": "n", "mass": 1, "position": [0, 0, 1],
                    "velocity": [0, 1e10, 0]}],
                   "trusses": [{"name": "t", "area": 1, "density": 1e300,
                    "young_modulus": 1, "ends": [{"ground": [0, 0, 0]},
                    {"node": "n"}]}], "rigid_bodies": [)",
                "box.json: /trusses/0: must be a truss whose energy [J], "
                "momentum [kg m/s] and angular momentum [kg m^2/s] at the "
                "start are finite numbers, got a mass of 1e+300 kg, with an "
                "end 1 m from the origin and one that moves at 1e+10 m/s"},
        Mistake{"SharedPointsTooFar", kGravity,
                R"("nodes": [{"name": "n", "mass": 1,
                    "position": [1e308, 1e308, 1e308]}],
                   "shared_points": [[{"body": "box", "point": [0, 0, 0]},
                    {"node": "n"}]], "rigid_bodies": [)",
                "box.json: /shared_points/0: must join points so near that "
                "their distance [m] is a finite number, got [0, 0, 0] and "
                "[1e+308, 1e+308, 1e+308] m"},
        Mistake{"SpringTooStiff", kGravity,
                R"("nodes": [{"name": "n", "mass": 1}],
                   "springs": [{"name": "s", "stiffness": 1e300,
                    "length": 1, "ends": [{"ground": [1e5, 0, 0]},
                    {"node": "n"}]}], "rigid_bodies": [)",
                "box.json: /springs/0: must be a spring whose energy at the "
                "start is a finite number [J], got a strain of 99999 and a "
                "stiffness of 1e+300 N/m"}),
    Name);

INSTANTIATE_TEST_SUITE_P(
    NotANumber, BadCaseTest,
    ::testing::Values(
        Mistake{"Overflow", "2700", "1e999",
                "box.json: /rigid_bodies/0/box/density: must be a finite "
                "number, got 1e999"},
        Mistake{"Null", "2700", "null",
                "box.json: /rigid_bodies/0/box/density: must be a finite "
                "number > 0 [kg/m^3], got null"},
        Mistake{"Text", "2700", "\"nan\"",
                "box.json: /rigid_bodies/0/box/density: must be a finite "
                "number > 0 [kg/m^3], got \"nan\""},
        Mistake{"NullInAVector", "[0.3, 0.5, 0.8]", "[0.3, null, 0.8]",
                "box.json: /rigid_bodies/0/angular_velocity/1: must be a "
                "finite number [rad/s], got null"},
        Mistake{"VectorOfFour", "[0.3, 0.5, 0.8]", "[0.3, 0.5, 0.8, 1]",
                "box.json: /rigid_bodies/0/angular_velocity: must be three "
                "finite numbers [rad/s], got [0.3,0.5,0.8,1]"}),
    Name);

INSTANTIATE_TEST_SUITE_P(
    KeysAndNames, BadCaseTest,
    ::testing::Values(
        Mistake{"UnknownKey", "\"density\"", "\"densty\"",
                "box.json: /rigid_bodies/0/box/densty: unknown key, expected "
                "one of: size, density (did you mean density?)"},
        Mistake{"MissingKey", ",\n    \"duration\": 1e-2", "",
                "box.json: /integrator/duration: required key is missing"},
        Mistake{"DuplicateKey", "\"duration\"", "\"time_step\"",
                "box.json: /integrator/time_step: duplicate key"},
        Mistake{"WrongFormat", "emmy-case/1", "emmy-case/2",
                "box.json: /format: must be \"emmy-case/1\", got "
                "\"emmy-case/2\""},
        Mistake{"UnknownMethod", "energy_momentum", "newmark",
                "box.json: /integrator/method: must be \"energy_momentum\", "
                "got \"newmark\""},
        Mistake{"PenaltyOfAConventionalBody", "\"penalty\"",
                "\"formulation\": \"conventional\", \"penalty\"",
                "box.json: /rigid_bodies/0/penalty: not allowed for a "
                "conventional body"},
        Mistake{"DuplicateName", kGravity,
                R"("nodes": [{"name": "box", "mass": 1}], "rigid_bodies": [)",
                "box.json: /nodes/0/name: must be unique, got \"box\", which "
                "is the name of /rigid_bodies/0"},
        Mistake{"DanglingBody", kGravity,
                R"("loads": [{"body": "bax", "torque": [0, 0, 1]}],
                   "rigid_bodies": [)",
                "box.json: /loads/0/body: must be the name of a rigid body, "
                "got \"bax\""},
        Mistake{"DanglingBodyOfATruss", kGravity,
                R"("trusses": [{"name": "t", "area": 1, "density": 0,
                    "young_modulus": 1, "ends": [{"ground": [9, 9, 9]},
                    {"body": "bax", "point": [0, 0, 0]}]}],
                   "rigid_bodies": [)",
                "box.json: /trusses/0/ends/1/body: must be the name of a "
                "rigid body, got \"bax\""},
        Mistake{"DanglingNode", kGravity,
                R"("springs": [{"name": "s", "stiffness": 1, "length": 1,
                    "ends": [{"node": "tip"}, {"ground": [9, 9, 9]}]}],
                   "rigid_bodies": [)",
                "box.json: /springs/0/ends/0/node: must be the name of a "
                "node, got \"tip\""},
        Mistake{"SharedPointsApart", kGravity,
                R"("shared_points": [[{"body": "box", "point": [0, 0, 0]},
                                      {"ground": [0, 0, 1]}]],
                   "rigid_bodies": [)",
                "box.json: /shared_points/0: must coincide at the start, got "
                "a gap of 1 m (allowed: 1e-09 of the model's size 1.81712 m)"}),
    Name);

class BadFileTest : public ProgramTest {};

TEST_F(BadFileTest, AMissingFileIsNamed) {
  const ProgramResult result = Run("run nowhere.json --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err,
            "nowhere.json: cannot be opened: No such file or directory\n");
  EXPECT_THAT(Files(), ElementsAre());
}

TEST_F(BadFileTest, AFolderIsNotACase) {
  const ProgramResult result = Run("run . --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err, ".: is a directory, must be a file\n");
}

TEST_F(BadFileTest, AnEmptyFileIsNotACase) {
  Write("box.json", "");
  EXPECT_EQ(Run("run box.json").err,
            "box.json: empty, must be a JSON object\n");
}

TEST_F(BadFileTest, ASyntaxErrorHasLineAndColumn) {
  Write("box.json", Replaced(kBoxCase, "\"name\": \"box\",\n  \"rigid_bodies\"",
                             "\"name\": \"box\"\n  \"rigid_bodies\""));
  const ProgramResult result = Run("run box.json --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_THAT(result.err,
              MatchesRegex("box.json: line 4, column [0-9]+: not valid JSON: "
                           "[^\n]*\n"));
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

TEST_F(BadFileTest, AnOutputFolderThatCannotBeMadeIsBadInput) {
  Write("box.json", kBoxCase);
  Write("out", "a file");
  const ProgramResult result = Run("run box.json --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err,
            "out: cannot be made a directory: a file of that name exists\n");
  EXPECT_EQ(Read("out"), "a file");
}

TEST_F(BadFileTest, AnOverrideAtFaultIsCalledThat) {
  Write("box.json", kBoxCase);
  const ProgramResult result =
      Run("run box.json --output out --set /rigid_bodies/0/penalty=-1");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err,
            "box.json: /rigid_bodies/0/penalty: must be a finite number > 0 "
            "[Pa], got -1 (from --set)\n");
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

TEST_F(BadFileTest, AnOverrideOfAPlaceThatDoesNotExistIsRejected) {
  Write("box.json", kBoxCase);
  const ProgramResult result = Run("run box.json --set /rigid_bodies/1/name=b");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err,
            "box.json: --set: /rigid_bodies/1: no such element, /rigid_bodies "
            "has 1 (counted from 0)\n");
}

struct WrongUse {
  const char* name;
  const char* arguments;
  const char* message;
  friend void PrintTo(const WrongUse& w, std::ostream* os) { *os << w.name; }
};

class UsageTest : public ProgramTest,
                  public ::testing::WithParamInterface<WrongUse> {};

TEST_P(UsageTest, ExitsWith2AndPointsToHelp) {
  Write("box.json", kBoxCase);
  const ProgramResult result = Run(GetParam().arguments);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_THAT(result.err, HasSubstr(GetParam().message));
  EXPECT_THAT(result.err, HasSubstr("--help"));
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

INSTANTIATE_TEST_SUITE_P(
    Commands, UsageTest,
    ::testing::Values(
        WrongUse{"NoCommand", "", "emmy: a command is required"},
        WrongUse{"UnknownCommand", "walk box.json", "walk"},
        WrongUse{"NoCase", "run", "CASE is required"},
        WrongUse{"UnknownOption", "run box.json --outptu x", "--outptu"},
        WrongUse{"NegativeSteps", "run box.json --steps -5 -o out",
                 "--steps: must be a whole number >= 0 [steps], got -5"},
        WrongUse{"HalfASteps", "run box.json --steps 0.5 -o out",
                 "--steps: must be a whole number >= 0 [steps], got 0.5"},
        WrongUse{"NoThreads", "run box.json --threads 0 -o out",
                 "--threads: must be a whole number from 1 to 1024, got 0"},
        WrongUse{"ThreadsOfNoNumber", "run box.json --threads two -o out",
                 "--threads: must be a whole number from 1 to 1024, got two"},
        WrongUse{"SizeOfNoNumber", "generate chain --size two --output x",
                 "--size: must be a whole number from 2 to 400000 for chain, "
                 "got two"},
        WrongUse{"NetTooLarge", "generate net --size 451 --output x",
                 "--size: must be a whole number from 2 to 450 for net, "
                 "got 451"},
        WrongUse{"CableNetFarTooLarge", "generate cable_net --size 10000000",
                 "--size: must be a whole number from 2 to 450 for cable_net, "
                 "got 10000000"},
        WrongUse{"ChainTooLarge", "generate chain --size 400001",
                 "--size: must be a whole number from 2 to 400000 for chain, "
                 "got 400001"},
        WrongUse{"ConventionalChainTooLarge",
                 "generate conventional_chain --size 400001",
                 "--size: must be a whole number from 2 to 400000 for "
                 "conventional_chain, got 400001"},
        WrongUse{"TrussedBoxesTooLarge",
                 "generate trussed_boxes --size 99999999999",
                 "--size: must be a whole number from 2 to 150000 for "
                 "trussed_boxes, got 99999999999"},
        WrongUse{"SizeTooSmall", "generate net --size 1 --output x",
                 "--size: must be a whole number from 2 to 450 for net, "
                 "got 1"},
        WrongUse{"SetWithoutValue", "run box.json --set", "--set"}),
    [](const auto& use) { return std::string(use.param.name); });

}  // namespace
}  // namespace emmy
