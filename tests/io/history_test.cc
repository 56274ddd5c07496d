#include "emmy/io/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/io/case_file.h"
#include "emmy/io/text_file.h"
#include "emmy/model/model_builder.h"

namespace emmy {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

BuiltModel TwoBodies(const std::string& first_name = "box") {
  ModelDescription description;
  RigidBodyDescription body;
  body.name = first_name;
  body.inertia = BoxInertia{Vector3d(3, 2, 1), 2700.0};
  body.penalty = 1e10;
  body.velocity = Vector3d(0.1, 0.2, 0.3);
  body.angular_velocity = Vector3d(0.3, 0.5, 0.8);
  description.rigid_bodies.push_back(body);
  body.name = "other";
  body.formulation = Formulation::kConventional;
  body.penalty = std::monostate();
  description.rigid_bodies.push_back(body);
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  EXPECT_TRUE(built.ok()) << built.status();
  return *std::move(built);
}

class HistoryTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(MakeDirectory(folder_).ok()); }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> Lines() {
    const std::string text = *ReadTextFile(path_, 1 << 20);
    EXPECT_EQ(text.back(), '\n');
    return absl::StrSplit(text.substr(0, text.size() - 1), '\n');
  }

  const std::string folder_ =
      ::testing::TempDir() + "emmy_history_" +
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string path_ = folder_ + "/history.csv";
};

TEST_F(HistoryTest, HasTheColumnsOfTheFormatInTheirOrder) {
  std::vector<std::string> columns = HistoryColumns(TwoBodies().model);
  ASSERT_EQ(columns.size(), 15u + 2u * 19u);
  columns.resize(15 + 19);
  EXPECT_THAT(
      columns,
      ElementsAre("step", "time", "kinetic_energy", "penalty_energy",
                  "elastic_energy", "gravity_energy", "load_work",
                  "total_energy", "momentum_x", "momentum_y", "momentum_z",
                  "angular_momentum_x", "angular_momentum_y",
                  "angular_momentum_z", "newton_iterations", "box.position_x",
                  "box.position_y", "box.position_z", "box.velocity_x",
                  "box.velocity_y", "box.velocity_z", "box.quaternion_w",
                  "box.quaternion_x", "box.quaternion_y", "box.quaternion_z",
                  "box.omega_x", "box.omega_y", "box.omega_z",
                  "box.omega_polar_x", "box.omega_polar_y", "box.omega_polar_z",
                  "box.omega_polar_exact_x", "box.omega_polar_exact_y",
                  "box.omega_polar_exact_z"));
}

TEST_F(HistoryTest, OnlyBeginReplacesWhatIsInTheFile) {
  const BuiltModel built = TwoBodies();
  ASSERT_TRUE(WriteTextFile(path_, "before\n").ok());
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Open(path_, built.model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  EXPECT_THAT(Lines(), ElementsAre("before"));
  EXPECT_TRUE(writer->Begin().ok());
  EXPECT_THAT(Lines(), ElementsAre(::testing::StartsWith("step,time,")));
}

TEST_F(HistoryTest, HasNodesTrussesAndSpringsAfterTheBodies) {
  ModelDescription description;
  description.nodes = {{.name = "ball", .mass = 1.0}};
  const GroundPoint ground{Vector3d(1, 0, 0)};
  description.springs = {{.name = "stay",
                          .ends = {NodePoint{"ball"}, ground},
                          .stiffness = 50.0,
                          .length = 0.5}};
  description.trusses = {{.name = "arm",
                          .ends = {NodePoint{"ball"}, ground},
                          .area = 1.0,
                          .young_modulus = 1.0}};
  const absl::StatusOr<BuiltModel> built = BuildModel(description);
  ASSERT_TRUE(built.ok()) << built.status();
  std::vector<std::string> columns = HistoryColumns(built->model);
  columns.erase(columns.begin(), columns.begin() + 15);
  EXPECT_THAT(
      columns,
      ElementsAre("ball.position_x", "ball.position_y", "ball.position_z",
                  "ball.velocity_x", "ball.velocity_y", "ball.velocity_z",
                  "arm.strain", "arm.force", "stay.strain", "stay.force"));

  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, built->model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  ASSERT_TRUE(writer
                  ->Write(built->model, built->state,
                          MeasureInvariants(built->model, built->state), 0)
                  .ok());
  const std::vector<std::string> fields = absl::StrSplit(Lines()[1], ',');
  ASSERT_EQ(fields.size(), 25u);
  EXPECT_EQ(fields[22], "0");   // The truss has its natural length.
  EXPECT_EQ(fields[24], "25");  // The spring is stretched by 0.5 m.
}

TEST_F(HistoryTest, WritesARowOfAllValuesWithAllTheirBits) {
  BuiltModel built = TwoBodies();
  built.state.step = 7;
  built.state.time.value = 0.1;
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, built.model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  Invariants invariants = MeasureInvariants(built.model, built.state);
  invariants.elastic_energy = 1.0 / 3.0;
  ASSERT_TRUE(writer->Write(built.model, built.state, invariants, 5).ok());

  const std::vector<std::string> lines = Lines();
  ASSERT_EQ(lines.size(), 2u);
  const std::vector<std::string> fields = absl::StrSplit(lines[1], ',');
  ASSERT_EQ(fields.size(), HistoryColumns(built.model).size());
  EXPECT_EQ(fields[0], "7");
  EXPECT_EQ(fields[1], "0.10000000000000001");
  EXPECT_EQ(fields[4], "0.33333333333333331");
  EXPECT_EQ(std::strtod(fields[7].c_str(), nullptr),
            invariants.TotalEnergy().ToDouble());
  EXPECT_EQ(fields[14], "5");
  EXPECT_EQ(fields[18], "0.10000000000000001");  // box.velocity_x
  EXPECT_EQ(std::strtod(fields[15 + 19 + 11].c_str(), nullptr), 0.5);
}

TEST_F(HistoryTest, EveryRowIsOnDiskAsSoonAsItIsWritten) {
  const BuiltModel built = TwoBodies();
  const Invariants invariants = MeasureInvariants(built.model, built.state);
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, built.model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  for (size_t rows = 1; rows <= 3; ++rows) {
    EXPECT_EQ(Lines().size(), rows);
    ASSERT_TRUE(writer->Write(built.model, built.state, invariants, 0).ok());
  }
}

// How often this process has written to anything; -1 if the system does not
// say.
int64_t NumberOfWrites() {
  const std::string io = ReadTextFile("/proc/self/io", 4096).value_or("");
  const std::string key = "syscw: ";
  const size_t place = io.find(key);
  if (place == std::string::npos) return -1;
  return std::strtoll(io.c_str() + place + key.size(), nullptr, 10);
}

// So that no reader sees part of it, as of one that fills a buffer.
TEST_F(HistoryTest, ALongRowIsWrittenInOnePiece) {
  if (NumberOfWrites() < 0) GTEST_SKIP() << "no count of writes here";
  ModelDescription description;
  for (int i = 0; i < 2000; ++i) {
    description.nodes.push_back(
        {.name = absl::StrCat(i),
         .mass = 1.0,
         .position = Vector3d(0.1 * i, 1.0 / 3.0, 2.0 / 3.0)});
  }
  const BuiltModel built = BuildModel(description).value();
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, built.model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  const Invariants invariants = MeasureInvariants(built.model, built.state);
  const int64_t before = NumberOfWrites();
  ASSERT_TRUE(writer->Write(built.model, built.state, invariants, 0).ok());
  EXPECT_EQ(NumberOfWrites() - before, 1);
  EXPECT_GT(Lines()[1].size(), 100000u);
}

TEST_F(HistoryTest, RefusesARowWithANumberThatIsNotFinite) {
  BuiltModel built = TwoBodies();
  const Invariants invariants = MeasureInvariants(built.model, built.state);
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, built.model);
  ASSERT_TRUE(writer.ok()) << writer.status();
  ASSERT_TRUE(writer->Write(built.model, built.state, invariants, 0).ok());
  built.state.step = 1;
  built.state.velocity.value(1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(writer->Write(built.model, built.state, invariants, 0).message(),
            path_ + ": box.velocity_y is not finite at step 1");
  EXPECT_EQ(Lines().size(), 2u);
}

TEST_F(HistoryTest, QuotesNamesThatWouldBreakTheTable) {
  const BuiltModel built = TwoBodies("a,\"b\"");
  ASSERT_TRUE(HistoryWriter::Create(path_, built.model).ok());
  EXPECT_THAT(Lines()[0], HasSubstr(",\"a,\"\"b\"\".position_x\","));
}

TEST_F(HistoryTest, ReportsAFullDisk) {
  fs::create_symlink("/dev/full", path_);
  const absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(path_, TwoBodies().model);
  EXPECT_EQ(writer.status().code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(writer.status().message(),
            path_ + ": cannot be written: No space left on device");
}

TEST_F(HistoryTest, ReportsAFolderThatIsMissing) {
  const absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Create(folder_ + "/none/history.csv", TwoBodies().model);
  EXPECT_EQ(writer.status().message(),
            folder_ +
                "/none/history.csv: cannot be opened: No such file or "
                "directory");
}

class ResumedHistoryTest : public HistoryTest {
 protected:
  // Two rows, the position after the first.
  void SetUp() override {
    HistoryTest::SetUp();
    absl::StatusOr<HistoryWriter> writer =
        HistoryWriter::Create(path_, built_.model);
    ASSERT_TRUE(writer.ok()) << writer.status();
    ASSERT_TRUE(Write(*writer, 1).ok());
    position_ = writer->Sync().value();
    after_one_ = *ReadTextFile(path_, 1 << 20);
    ASSERT_TRUE(Write(*writer, 2).ok());
    after_two_ = *ReadTextFile(path_, 1 << 20);
  }

  absl::Status Write(HistoryWriter& writer, int iterations) {
    return writer.Write(built_.model, built_.state,
                        MeasureInvariants(built_.model, built_.state),
                        iterations);
  }

  // The message, with nothing in the file changed.
  std::string Refusal(const std::string& path) {
    const std::string before = *ReadTextFile(path_, 1 << 20);
    const absl::StatusOr<HistoryWriter> writer =
        HistoryWriter::Resume(path, built_.model, position_);
    EXPECT_FALSE(writer.ok());
    EXPECT_EQ(*ReadTextFile(path_, 1 << 20), before);
    return std::string(writer.status().message());
  }

  BuiltModel built_ = TwoBodies();
  HistoryPosition position_;
  std::string after_one_;
  std::string after_two_;
};

TEST_F(ResumedHistoryTest, CutsOffWhatIsBeyondAndGoesOn) {
  absl::StatusOr<HistoryWriter> writer =
      HistoryWriter::Resume(path_, built_.model, position_);
  ASSERT_TRUE(writer.ok()) << writer.status();
  EXPECT_EQ(*ReadTextFile(path_, 1 << 20), after_one_);
  ASSERT_TRUE(Write(*writer, 2).ok());
  EXPECT_EQ(*ReadTextFile(path_, 1 << 20), after_two_);
  EXPECT_EQ(writer->Sync().value().bytes, after_two_.size());
}

TEST_F(ResumedHistoryTest, RefusesAFileThatIsShortOrWasChanged) {
  ASSERT_TRUE(
      WriteTextFile(path_, after_one_.substr(0, after_one_.size() - 7)).ok());
  EXPECT_THAT(Refusal(path_), HasSubstr("the checkpoint was written at"));
  std::string changed = after_one_;
  char& middle = changed[changed.size() / 2];
  middle = static_cast<char>(middle ^ 1);
  ASSERT_TRUE(WriteTextFile(path_, changed).ok());
  EXPECT_THAT(Refusal(path_),
              HasSubstr("is not the history of the checkpoint"));
}

TEST_F(ResumedHistoryTest, RefusesWhatIsNoFile) {
  EXPECT_THAT(Refusal(folder_), HasSubstr("is not a regular file"));
  EXPECT_THAT(Refusal(folder_ + "/none"),
              HasSubstr("cannot be continued: No such file or directory"));
}

}  // namespace
}  // namespace emmy
