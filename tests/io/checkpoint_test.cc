// A checkpoint comes back bit for bit, or is refused with the reason.

#include "emmy/io/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "emmy/base/crc64.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/text_file.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr size_t kFirstLine = 18;  // "emmy-checkpoint/1\n"

class CheckpointTest : public ::testing::Test {
 protected:
  CheckpointTest() {
    case_.name = "tangle";
    case_.model = Tangle();
    case_.integrator.time_step = 1e-3;
    case_.integrator.duration = 1.0;
    const BuiltModel built = BuildModel(case_.model).value();
    start_ = built.state;
    EnergyMomentumIntegrator integrator =
        EnergyMomentumIntegrator::Create(built.model, {.time_step = 1e-3})
            .value();
    checkpoint_.state = built.state;
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(integrator.Step(checkpoint_.state).ok());
    }
    checkpoint_.case_name = case_.name;
    checkpoint_.case_checksum = CaseChecksum(case_);
    checkpoint_.build = CheckpointBuild();
    checkpoint_.kept = integrator.Keep();
    checkpoint_.extremes = {{1e-17, 0.0, 3e-17}, {7e3, 1.0 / 3.0, 2e4}};
    checkpoint_.total_iterations = 12;
    checkpoint_.max_iterations = 5;
    checkpoint_.last_iterations = 3;
    checkpoint_.wall_seconds = 0.1;
    checkpoint_.history = HistoryPosition{1234, 0xFEDCBA9876543210U};
  }

  // With a checksum that is right.
  static std::string Sealed(std::string bytes) {
    bytes.resize(bytes.size() - 8);
    const uint64_t sum = Crc64(bytes);
    for (int i = 0; i < 8; ++i) {
      bytes.push_back(static_cast<char>((sum >> (8 * i)) & 0xFFU));
    }
    return bytes;
  }

  Case case_;
  State start_;
  Checkpoint checkpoint_;
};

TEST_F(CheckpointTest, EveryFieldComesBack) {
  const std::string bytes = EncodeCheckpoint(checkpoint_).value();
  const Checkpoint back = DecodeCheckpoint(bytes).value();
  EXPECT_EQ(back.case_name, "tangle");
  EXPECT_EQ(back.case_checksum, checkpoint_.case_checksum);
  EXPECT_EQ(back.build, CheckpointBuild());
  EXPECT_TRUE(SameState(back.state, checkpoint_.state));
  EXPECT_EQ(back.state.load_work.compensation,
            checkpoint_.state.load_work.compensation);
  ASSERT_EQ(back.kept.size(), checkpoint_.kept.size());
  for (size_t i = 0; i < back.kept.size(); ++i) {
    EXPECT_EQ(back.kept[i].matrix, checkpoint_.kept[i].matrix);
    EXPECT_EQ(back.kept[i].positions, checkpoint_.kept[i].positions);
    EXPECT_EQ(back.kept[i].turn, checkpoint_.kept[i].turn);
  }
  EXPECT_EQ(back.extremes.max_error, checkpoint_.extremes.max_error);
  EXPECT_EQ(back.extremes.scale, checkpoint_.extremes.scale);
  EXPECT_EQ(back.total_iterations, 12);
  EXPECT_EQ(back.max_iterations, 5);
  EXPECT_EQ(back.last_iterations, 3);
  EXPECT_EQ(back.wall_seconds, 0.1);
  ASSERT_TRUE(back.history.has_value());
  EXPECT_EQ(back.history->bytes, 1234U);
  EXPECT_EQ(back.history->checksum, 0xFEDCBA9876543210U);
  // Every bit, the sign of zero included: the same text again.
  EXPECT_EQ(EncodeCheckpoint(back).value(), bytes);
}

// The fields in their order, each number one more than that before. Who changes
// this list changes the number of the format, if there has been a release with
// it.
TEST(CheckpointLayoutTest, IsThatOfVersionOne) {
  double number = 0.0;
  const auto fill = [&number](auto& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = ++number;
  };
  const auto fill_sum = [&](CompensatedVector& sum) {
    sum.SetZero(2);
    fill(sum.value);
    fill(sum.compensation);
  };
  const auto fill_sequence = [&](Extrapolation& sequence) {
    sequence.SetZero(1);
    fill(sequence.next);
    fill(sequence.differences);
  };
  Checkpoint checkpoint;
  checkpoint.case_name = "case";
  checkpoint.case_checksum = 100;
  checkpoint.build = "build";
  State& state = checkpoint.state;
  state.step = 101;
  state.time = {++number, ++number};
  fill_sum(state.position);
  fill_sum(state.velocity);
  fill_sum(state.strain);
  fill_sum(state.end_velocity);
  state.load_work = {++number, ++number};
  fill_sequence(state.acceleration);
  fill_sequence(state.multiplier);
  KeptTangent kept{.matrix = VectorXd(2), .positions = Matrix3Xd(3, 2)};
  fill(kept.matrix);
  fill(kept.positions);
  fill(kept.turn);
  kept.fewest_iterations = 107;
  kept.excess_iterations = 108;
  checkpoint.kept = {kept};
  for (double& error : checkpoint.extremes.max_error) error = ++number;
  for (double& scale : checkpoint.extremes.scale) scale = ++number;
  checkpoint.total_iterations = 102;
  checkpoint.max_iterations = 103;
  checkpoint.last_iterations = 104;
  checkpoint.wall_seconds = ++number;
  checkpoint.history = HistoryPosition{105, 106};

  const std::string bytes = EncodeCheckpoint(checkpoint).value();
  // The first line, the length, the fields, and the sum of all before it.
  EXPECT_EQ(bytes.size(), 18U + 8U + 785U + 8U);
  EXPECT_EQ(Crc64(bytes.substr(0, bytes.size() - 8)), 8154566751565594202U);
}

TEST_F(CheckpointTest, KeepsSignsOfZeroAndDenormalNumbers) {
  checkpoint_.state.position.compensation(0) = -0.0;
  checkpoint_.state.position.compensation(1) =
      std::numeric_limits<double>::denorm_min();
  checkpoint_.history.reset();
  const Checkpoint back =
      DecodeCheckpoint(EncodeCheckpoint(checkpoint_).value()).value();
  EXPECT_TRUE(std::signbit(back.state.position.compensation(0)));
  EXPECT_EQ(back.state.position.compensation(1),
            std::numeric_limits<double>::denorm_min());
  EXPECT_FALSE(back.history.has_value());
}

TEST_F(CheckpointTest, IsRefusedWhereverItIsCutOff) {
  const std::string bytes = EncodeCheckpoint(checkpoint_).value();
  EXPECT_EQ(DecodeCheckpoint("").status().message(), "is not a checkpoint");
  for (size_t size = 1; size < bytes.size(); ++size) {
    const absl::Status status =
        DecodeCheckpoint(bytes.substr(0, size)).status();
    ASSERT_EQ(status.message(), "the checkpoint is cut off after " +
                                    std::to_string(size) + " bytes");
  }
}

TEST_F(CheckpointTest, IsRefusedWithAnyBitFlipped) {
  const std::string bytes = EncodeCheckpoint(checkpoint_).value();
  // All bits of the frame; of the rest, where every byte has its turn.
  for (size_t bit = 0; bit < 8 * bytes.size(); bit += bit < 1000 ? 1 : 11) {
    std::string wrong = bytes;
    wrong[bit / 8] = static_cast<char>(wrong[bit / 8] ^ (1 << (bit % 8)));
    const absl::Status status = DecodeCheckpoint(wrong).status();
    ASSERT_FALSE(status.ok()) << "bit " << bit;
    ASSERT_THAT(std::string(status.message()),
                AnyOf("is not a checkpoint", StartsWith("has the format "),
                      StartsWith("the checkpoint is cut off after "),
                      StartsWith("the checkpoint is damaged: ")))
        << "bit " << bit;
  }
}

TEST_F(CheckpointTest, IsRefusedWithSomethingAfterIt) {
  EXPECT_EQ(DecodeCheckpoint(EncodeCheckpoint(checkpoint_).value() + "x")
                .status()
                .message(),
            "the checkpoint is damaged: there is something after its end");
}

TEST_F(CheckpointTest, ANewerVersionIsCalledThat) {
  std::string bytes = EncodeCheckpoint(checkpoint_).value();
  bytes.replace(0, kFirstLine, "emmy-checkpoint/12\n");
  EXPECT_EQ(DecodeCheckpoint(bytes).status().message(),
            "has the format emmy-checkpoint/12; this version of emmy reads "
            "emmy-checkpoint/1 only");
}

TEST_F(CheckpointTest, OtherFilesAreNotCheckpoints) {
  EXPECT_EQ(
      DecodeCheckpoint("{\"format\": \"emmy-case/1\"}").status().message(),
      "is not a checkpoint");
}

TEST_F(CheckpointTest, NumbersThatAreNotFiniteAreNeitherWrittenNorRead) {
  Checkpoint wrong = checkpoint_;
  wrong.state.velocity.value(1) = std::nan("");
  EXPECT_EQ(EncodeCheckpoint(wrong).status().message(),
            "no checkpoint: velocity is not finite");
  wrong = checkpoint_;
  wrong.kept[0].matrix(0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(EncodeCheckpoint(wrong).status().message(),
            "no checkpoint: factorised matrix is not finite");

  // Written by something else, with a checksum that is right.
  std::string bytes = EncodeCheckpoint(checkpoint_).value();
  const double mark = checkpoint_.state.velocity.value(1);
  std::string pattern(8, '\0');
  std::memcpy(pattern.data(), &mark, 8);
  const size_t place = bytes.find(pattern);
  ASSERT_NE(place, std::string::npos);
  const double nan = std::nan("");
  std::memcpy(&bytes[place], &nan, 8);
  EXPECT_EQ(DecodeCheckpoint(Sealed(bytes)).status().message(),
            "the checkpoint is damaged: velocity is not finite");
}

// Sizes are believed only as far as there are bytes.
TEST_F(CheckpointTest, HugeSizesTakeNoMemory) {
  const std::string bytes = EncodeCheckpoint(checkpoint_).value();
  for (size_t place = kFirstLine + 8; place + 16 < bytes.size(); place += 8) {
    std::string wrong = bytes;
    std::fill_n(wrong.begin() + static_cast<std::ptrdiff_t>(place), 6, '\x7F');
    static_cast<void>(DecodeCheckpoint(Sealed(wrong)).status());  // Ends.
  }
}

TEST_F(CheckpointTest, BelongsToItsCaseOnly) {
  EXPECT_TRUE(CheckSameCase(checkpoint_, case_, start_).ok());
  Case other = case_;
  other.name = "other";
  EXPECT_EQ(CheckSameCase(checkpoint_, other, start_).message(),
            "is a checkpoint of the case \"tangle\", this is \"other\"");
  other = case_;
  other.integrator.time_step = std::nextafter(1e-3, 1.0);
  EXPECT_THAT(std::string(CheckSameCase(checkpoint_, other, start_).message()),
              HasSubstr("another version of the case \"tangle\""));
  State smaller = start_;
  smaller.position.SetZero(3);
  EXPECT_EQ(CheckSameCase(checkpoint_, case_, smaller).message(),
            "the checkpoint is damaged: its state does not fit the model");
}

class CheckpointFileTest : public CheckpointTest {
 protected:
  CheckpointFileTest() {
    std::string pattern = ::testing::TempDir() + "emmy_checkpoint_XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  ~CheckpointFileTest() override { std::filesystem::remove_all(folder_); }

  std::string folder_;
};

TEST_F(CheckpointFileTest, IsReplacedAsAWhole) {
  const std::string path = folder_ + "/checkpoint";
  ASSERT_TRUE(WriteCheckpoint(path, checkpoint_).ok());
  checkpoint_.state.step = 4;
  ASSERT_TRUE(WriteCheckpoint(path, checkpoint_).ok());
  EXPECT_EQ(ReadCheckpoint(path).value().state.step, 4);

  // What cannot be written leaves what is there.
  checkpoint_.state.time.value = std::nan("");
  EXPECT_EQ(WriteCheckpoint(path, checkpoint_).message(),
            path + ": no checkpoint: time is not finite");
  EXPECT_EQ(ReadCheckpoint(path).value().state.step, 4);
}

TEST_F(CheckpointFileTest, MessagesNameTheFile) {
  EXPECT_EQ(ReadCheckpoint(folder_ + "/none").status().message(),
            folder_ + "/none: cannot be opened: No such file or directory");
  EXPECT_EQ(ReadCheckpoint(folder_).status().message(),
            folder_ + ": is not a regular file");
  EXPECT_EQ(ReadCheckpoint("/dev/zero").status().message(),
            "/dev/zero: is not a regular file");
  ASSERT_TRUE(WriteTextFile(folder_ + "/empty", "").ok());
  EXPECT_EQ(ReadCheckpoint(folder_ + "/empty").status().message(),
            folder_ + "/empty: is not a checkpoint");
}

}  // namespace
}  // namespace emmy
