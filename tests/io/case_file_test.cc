#include "emmy/io/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <variant>

#include "emmy/io/case_writer.h"
#include "emmy/io/text_file.h"
#include "tests/io/case_text.h"
#include "tests/io/random_case.h"
#include "tests/io/sample_case.h"

namespace emmy {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Case Sample() {
  absl::StatusOr<Case> result = ParseCase(kSampleCase);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *result : Case();
}

TEST(ReadCaseTest, FillsTheBodies) {
  const Case sample = Sample();
  ASSERT_EQ(sample.model.rigid_bodies.size(), 3u);
  const RigidBodyDescription& box = sample.model.rigid_bodies[0];
  EXPECT_EQ(std::get<BoxInertia>(box.inertia).size, Vector3d(3, 2, 1));
  EXPECT_EQ(std::get<double>(box.penalty), 1e10);
  EXPECT_FALSE(box.angular_velocity_in_body_axes);
  const RigidBodyDescription& wheel = sample.model.rigid_bodies[1];
  const Matrix3d diagonal = Vector3d(1, 1, 1.5).asDiagonal();
  EXPECT_EQ(std::get<TensorInertia>(wheel.inertia).tensor, diagonal);
  EXPECT_EQ((std::get<std::array<double, 6>>(wheel.penalty)[3]), 1e7);
  EXPECT_EQ(std::get<RotationVector>(wheel.orientation).vector,
            Vector3d(0.1, 0.2, 0.3));
  EXPECT_TRUE(wheel.angular_velocity_in_body_axes);
  EXPECT_EQ(wheel.start, Start::kRelaxed);
  const RigidBodyDescription& drum = sample.model.rigid_bodies[2];
  EXPECT_EQ(drum.formulation, Formulation::kConventional);
  EXPECT_EQ(std::get<TensorInertia>(drum.inertia).tensor(1, 0), 0.1);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(drum.penalty));
}

TEST(ReadCaseTest, FillsWhatIsBetweenTheBodies) {
  const Case sample = Sample();
  const ModelDescription& model = sample.model;
  ASSERT_EQ(model.nodes.size(), 2u);
  EXPECT_EQ(std::get<MovesWith>(model.nodes[0].velocity).body, "box");
  EXPECT_EQ(std::get<Vector3d>(model.nodes[1].velocity), Vector3d(1, 0, 0));
  ASSERT_EQ(model.trusses.size(), 1u);
  EXPECT_EQ(std::get<BodyPoint>(model.trusses[0].ends[0]).point,
            Vector3d(1.5, 1.0, 0.5));
  EXPECT_EQ(model.trusses[0].length, 0.8);
  ASSERT_EQ(model.springs.size(), 1u);
  EXPECT_EQ(std::get<GroundPoint>(model.springs[0].ends[1]).position,
            Vector3d(0, 6, 0));
  EXPECT_EQ(model.shared_points.size(), 1u);
  ASSERT_EQ(model.loads.size(), 2u);
  EXPECT_EQ(std::get<ForceLoad>(model.loads[0]).force, Vector3d(0, 0, 1));
  EXPECT_EQ(std::get<TorqueLoad>(model.loads[1]).body, "wheel");
}

TEST(ReadCaseTest, UsesTheDocumentedDefaults) {
  const absl::StatusOr<Case> result = ParseCase(R"({
    "format": "emmy-case/1", "name": "short",
    "rigid_bodies": [{"name": "b", "penalty": 1,
                      "box": {"size": [1, 1, 1], "density": 1}}],
    "nodes": [{"name": "n", "mass": 1}],
    "trusses": [{"name": "t", "ends": [{"node": "n"}, {"ground": [1, 0, 0]}],
                 "area": 1, "density": 0, "young_modulus": 1}],
    "integrator": {"method": "energy_momentum", "time_step": 1,
                   "duration": 1}})");
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->purpose, "");
  EXPECT_EQ(result->model.gravity, Vector3d(0, 0, 0));
  const RigidBodyDescription& body = result->model.rigid_bodies[0];
  EXPECT_EQ(body.formulation, Formulation::kAncf);
  EXPECT_EQ(body.position, Vector3d(0, 0, 0));
  EXPECT_EQ(std::get<Quaternion>(body.orientation).w, 1.0);
  EXPECT_EQ(body.velocity, Vector3d(0, 0, 0));
  EXPECT_EQ(body.angular_velocity, Vector3d(0, 0, 0));
  EXPECT_EQ(body.start, Start::kUndeformed);
  const NodeDescription& node = result->model.nodes[0];
  EXPECT_EQ(node.position, Vector3d(0, 0, 0));
  EXPECT_EQ(std::get<Vector3d>(node.velocity), Vector3d(0, 0, 0));
  EXPECT_FALSE(node.fixed);
  EXPECT_FALSE(result->model.trusses[0].length.has_value());
  EXPECT_FALSE(result->model.trusses[0].tension_only);
  EXPECT_TRUE(result->model.springs.empty());
  EXPECT_TRUE(result->model.shared_points.empty());
  EXPECT_TRUE(result->model.loads.empty());
  EXPECT_EQ(result->integrator.order, 2);
  EXPECT_FALSE(result->integrator.tolerance.has_value());
  EXPECT_EQ(result->output_every, 1);
}

TEST(ReadCaseTest, AWholeNumberMayHaveAPoint) {
  const absl::StatusOr<Case> result =
      ParseCase(kSampleCase, {"/integrator/order=2.0", "/output/every=1e2"});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->integrator.order, 2);
  EXPECT_EQ(result->output_every, 100);
}

TEST(ReadCaseTest, OverridesApplyInOrder) {
  const absl::StatusOr<Case> result = ParseCase(
      kSampleCase, {"/integrator/tolerance=0.1", "/integrator/tolerance=0.2"});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->integrator.tolerance, 0.2);
}

TEST(WriteCaseTest, ReadingAWrittenCaseGivesTheSameCaseBitForBit) {
  std::mt19937_64 random(20240917);  // Fixed seed: failures can be replayed.
  for (int trial = 0; trial < 500; ++trial) {
    const Case original = RandomCase(random);
    const absl::StatusOr<Case> back = ParseCase(WriteCase(original));
    ASSERT_TRUE(back.ok()) << "trial " << trial << ": " << back.status();
    ASSERT_EQ(CaseText(*back), CaseText(original)) << "trial " << trial;
  }
}

TEST(WriteCaseTest, AWrittenCaseIsReadable) {
  const std::string text = WriteCase(Sample());
  EXPECT_THAT(text, HasSubstr(R"(  "gravity": [0.0, 0.0, -9.81],)"));
  EXPECT_THAT(text, HasSubstr(R"(    "time_step": 0.001,)"));
}

class CaseFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(MakeDirectory(folder_).ok());
    path_ = folder_ + "/box.json";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string LoadError(const std::string& text,
                        const std::vector<std::string>& overrides = {}) {
    EXPECT_TRUE(WriteTextFile(path_, text).ok());
    const absl::StatusOr<LoadedCase> loaded = LoadCaseFile(path_, overrides);
    return loaded.ok() ? "no error" : std::string(loaded.status().message());
  }

  const std::string folder_ =
      ::testing::TempDir() +
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string path_;
};

constexpr char kBox[] = R"({
  "format": "emmy-case/1", "name": "box",
  "rigid_bodies": [{"name": "box", "penalty": 1e10,
                    "box": {"size": [3, 2, 1], "density": 2700}}],
  "integrator": {"method": "energy_momentum", "time_step": 1e-3,
                 "duration": 1}})";

TEST_F(CaseFileTest, LoadsAModelThatIsReadyToRun) {
  ASSERT_TRUE(WriteTextFile(path_, kBox).ok());
  const absl::StatusOr<LoadedCase> loaded = LoadCaseFile(path_);
  ASSERT_TRUE(loaded.ok()) << loaded.status();
  EXPECT_EQ(loaded->description.name, "box");
  EXPECT_EQ(loaded->model.degrees_of_freedom(), 12);
  EXPECT_EQ(loaded->state.step, 0);
}

TEST_F(CaseFileTest, PutsTheFileNameBeforeErrorsOfStructure) {
  EXPECT_EQ(LoadError("{}"), path_ + ": /format: required key is missing");
}

TEST_F(CaseFileTest, PutsTheFileNameBeforeErrorsOfTheModel) {
  std::string text = kBox;
  text.replace(text.find("2700"), 4, "-2700");
  EXPECT_EQ(LoadError(text), path_ +
                                 ": /rigid_bodies/0/box/density: must be a "
                                 "finite number > 0 [kg/m^3], got -2700");
}

TEST_F(CaseFileTest, PutsTheFileNameBeforeSyntaxErrors) {
  EXPECT_THAT(LoadError("{\n  oops\n}"),
              StartsWith(path_ + ": line 2, column 3: not valid JSON: "));
}

TEST_F(CaseFileTest, SaysThatAValueAtFaultCameFromOutside) {
  EXPECT_EQ(LoadError(kBox, {"/rigid_bodies/0/box/density=-1"}),
            path_ +
                ": /rigid_bodies/0/box/density: must be a finite number > 0 "
                "[kg/m^3], got -1 (from --set)");
  EXPECT_EQ(LoadError(kBox, {"/integrator/order=3", "/name=b"}),
            path_ +
                ": /integrator/order: must be 2, 4 or 6, got 3 (from "
                "--set)");
  EXPECT_EQ(
      LoadError(kBox, {R"(/integrator={"order": 3})"}),
      path_ + ": /integrator/method: required key is missing (from --set)");
}

TEST_F(CaseFileTest, NamesAFileThatIsMissing) {
  EXPECT_EQ(ReadCaseFile("nowhere.json").status().message(),
            "nowhere.json: cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace emmy
