// A run that is stopped, by whatever, and resumed gives the bytes of one that
// never stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "emmy/io/case_writer.h"
#include "emmy/io/checkpoint.h"
#include "tests/cli/program.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ResumeTest : public ProgramTest {
 protected:
  ResumeTest() {
    // Every kind of part: what a structure keeps from step to step counts.
    Case tangle;
    tangle.name = "tangle";
    tangle.model = Tangle();
    tangle.integrator.time_step = 1e-3;
    tangle.integrator.duration = 0.1;
    tangle.output_every = 30;
    Write("tangle.json", WriteCase(tangle));
  }

  // The summary in `folder`, but for the time it took.
  json Summary(const std::string& folder) const {
    json summary = json::parse(Read(folder + "/summary.json"));
    summary.erase("wall_seconds");
    return summary;
  }

  bool Has(const std::string& name) const {
    return Shell("test -e '" + name + "'").exit_status == 0;
  }

  Checkpoint Decode(const std::string& name) const {
    return DecodeCheckpoint(Read(name)).value();
  }

  // Ends with the results and the checkpoint of `whole`, but for times.
  void ExpectSameResults(const std::string& whole, const std::string& folder) {
    // Not EXPECT_EQ: a failure would print both files.
    EXPECT_TRUE(Read(folder + "/history.csv") == Read(whole + "/history.csv"));
    EXPECT_EQ(Summary(folder), Summary(whole));
    Checkpoint a = Decode(whole + "/checkpoint");
    Checkpoint b = Decode(folder + "/checkpoint");
    a.wall_seconds = b.wall_seconds;
    EXPECT_TRUE(EncodeCheckpoint(a).value() == EncodeCheckpoint(b).value());
  }
};

TEST_F(ResumeTest, AStoppedRunGoesOnAsIfItNeverHadBeen) {
  EXPECT_EQ(Run("run tangle.json --output whole --quiet --checkpoint "
                "whole/checkpoint")
                .exit_status,
            0);
  // 47 is no output step: the row of this end must not stay.
  EXPECT_EQ(Run("run tangle.json --output parts --quiet --steps 47 "
                "--checkpoint parts/checkpoint")
                .exit_status,
            0);
  EXPECT_THAT(Read("parts/history.csv"), HasSubstr("\n47,"));
  const ProgramResult result =
      Run("run tangle.json --output parts --quiet --resume parts/checkpoint");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.err, "");
  ExpectSameResults("whole", "parts");
  EXPECT_EQ(Decode("parts/checkpoint").state.step, 100);
  // Once more: nothing is left to do, and nothing changes.
  EXPECT_EQ(Run("run tangle.json --output parts --quiet --resume "
                "parts/checkpoint")
                .exit_status,
            0);
  ExpectSameResults("whole", "parts");
}

TEST_F(ResumeTest, ARunWithoutHistoryCanBeResumedToo) {
  const json whole = json::parse(Run("run tangle.json").out);
  Run("run tangle.json --steps 47 --checkpoint c");
  const json parts = json::parse(Run("run tangle.json --resume c").out);
  EXPECT_EQ(parts["invariants"], whole["invariants"]);
  EXPECT_EQ(parts["newton"], whole["newton"]);
  EXPECT_EQ(parts["steps"], 100);
}

// The bits of a run do not depend on whether and how often it is saved.
TEST_F(ResumeTest, CheckpointsDoNotChangeTheResults) {
  Run("run tangle.json --output without --quiet");
  Run("run tangle.json --output with --quiet --checkpoint c "
      "--checkpoint-every 1");
  EXPECT_TRUE(Read("with/history.csv") == Read("without/history.csv"));
}

TEST_F(ResumeTest, SurvivesBeingKilledAtFiftyRandomMoments) {
  const std::string common =
      " run tangle.json --set /output/every=7 --quiet --checkpoint-every 20 ";
  // How long a run of so many steps takes.
  const auto run_whole = [this, &common](int steps) {
    Shell("rm -rf whole");
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(
        Shell(absl::StrCat("\"$EMMY\"", common, "--steps ", steps,
                           " --output whole --checkpoint whole/checkpoint"))
            .exit_status,
        0);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start)
        .count();
  };
  constexpr int kSteps = 1500;
  const double beginning = run_whole(1);
  const double whole = run_whole(kSteps);

  constexpr int kKills = 50;
  constexpr int kMostKills = 20 * kKills;
  constexpr size_t kPlaces = 6;
  // A few checkpoints apart, on a machine of any speed: what a run needs
  // before its first step may be longer than its steps.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> delay(
      0.5 * beginning, beginning + std::max(0.01, (whole - beginning) / 5.0));
  int kills = 0;
  std::set<int64_t> resumed;  // Steps from which a killed run went on.
  const auto enough = [&] {
    return kills >= kMostKills ||
           (kills >= kKills && resumed.size() >= kPlaces);
  };
  while (!enough()) {
    Shell("rm -rf parts");
    ProgramResult result;
    int starts = 0;
    do {
      // Without a checkpoint yet, the run has not begun.
      result = Shell(absl::StrCat(
          enough() ? "" : absl::StrCat("timeout -s KILL ", delay(random), " "),
          "\"$EMMY\"", common, "--steps ", kSteps, " --output parts ",
          Has("parts/checkpoint") ? "--resume" : "--checkpoint",
          " parts/checkpoint"));
      if (result.exit_status == 137 || result.exit_status == -1) {
        ++kills;
        if (Has("parts/checkpoint")) {
          resumed.insert(Decode("parts/checkpoint").state.step);
        }
      }
      ASSERT_LT(++starts, 10000);
    } while (result.exit_status == 137 || result.exit_status == -1);
    ASSERT_EQ(result.exit_status, 0) << result.err;
    ASSERT_EQ(result.err, "");
    ExpectSameResults("whole", "parts");
  }
  EXPECT_GE(resumed.size(), kPlaces);
  RecordProperty("resumed_from", static_cast<int>(resumed.size()));
}

TEST_F(ResumeTest, ASignalEndsTheRunWithACheckpointAndSaysHowToGoOn) {
  for (const char* signal : {"TERM", "INT"}) {
    Shell("rm -rf out c");
    const ProgramResult result = Shell(
        absl::StrCat("\"$EMMY\" run tangle.json --output out --quiet --set "
                     "'/name=two words' --steps 1000000000 --checkpoint c &\n"
                     "until [ -s c ]; do sleep 0.02; done\nkill -",
                     signal, " $!\nwait $!\n"));
    EXPECT_EQ(result.exit_status, 3);
    const Checkpoint stopped = Decode("c");
    const std::string message = Summary("out")["message"];
    EXPECT_THAT(message, StartsWith(absl::StrCat("interrupted after step ",
                                                 stopped.state.step, " at ")));
    EXPECT_EQ(result.err,
              absl::StrCat("tangle.json: ", message,
                           "\nTo go on: emmy run tangle.json --output out "
                           "--set '/name=two words' --steps 1000000000 "
                           "--quiet --resume c\n"));
    EXPECT_EQ(Summary("out")["status"], "interrupted");

    // What it says works, here to an end that is nearer.
    const std::string steps = absl::StrCat(stopped.state.step + 35);
    const size_t command = result.err.find("emmy run");
    ASSERT_NE(command, std::string::npos);
    const ProgramResult resumed = Shell(absl::StrReplaceAll(
        result.err.substr(command),
        {{"emmy run", "\"$EMMY\" run"}, {"1000000000", steps}}));
    EXPECT_EQ(resumed.exit_status, 0) << resumed.err;
    Run("run tangle.json --output whole --quiet --set '/name=two words' "
        "--steps " +
        steps);
    EXPECT_TRUE(Read("out/history.csv") == Read("whole/history.csv"));
    EXPECT_EQ(Summary("out"), Summary("whole"));
  }
}

TEST_F(ResumeTest, AFullDiskLeavesWhatItTakesToGoOn) {
  const std::string run =
      "\"$EMMY\" run tangle.json --output out --quiet --steps 200 "
      "--set /output/every=1 --checkpoint-every 5 ";
  // In blocks of 512 or 1024 bytes: more than the checkpoint, less than the
  // history.
  const ProgramResult result =
      Shell("ulimit -f 128; " + run + "--checkpoint c");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.err,
              StartsWith("tangle.json: out/history.csv: cannot be written: "
                         "File too large\nTo go on: emmy run tangle.json"));
  const Checkpoint last = Decode("c");
  EXPECT_GT(last.state.step, 0);
  EXPECT_LT(last.state.step, 200);
  const std::string history = Read("out/history.csv");
  EXPECT_EQ(history.back(), '\n');
  EXPECT_GE(history.size(), last.history->bytes);
  EXPECT_EQ(Shell(run + "--resume c").exit_status, 0);
  Run("run tangle.json --output whole --quiet --steps 200 "
      "--set /output/every=1");
  EXPECT_TRUE(Read("out/history.csv") == Read("whole/history.csv"));
  EXPECT_EQ(Summary("out"), Summary("whole"));
}

// Where there is not yet a checkpoint of the new name.
TEST_F(ResumeTest, AFullDiskBeforeTheFirstCheckpointNamesTheOneItBeganFrom) {
  const std::string run =
      "\"$EMMY\" run tangle.json --output out --quiet "
      "--set /output/every=1 --checkpoint-every 100000 ";
  EXPECT_EQ(Shell(run + "--steps 20 --checkpoint c").exit_status, 0);
  const ProgramResult result =
      Shell("ulimit -f 128; " + run + "--steps 200 --resume c --checkpoint d");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(Files(), Not(Contains("d")));
  const size_t command = result.err.find("emmy run tangle.json");
  ASSERT_NE(command, std::string::npos) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--checkpoint d --resume c"));
  const ProgramResult resumed = Shell(absl::StrReplaceAll(
      result.err.substr(command), {{"emmy run", "\"$EMMY\" run"}}));
  EXPECT_EQ(resumed.exit_status, 0) << resumed.err;
  EXPECT_EQ(Decode("d").state.step, 200);
  Run("run tangle.json --output whole --quiet --steps 200 "
      "--set /output/every=1");
  EXPECT_TRUE(Read("out/history.csv") == Read("whole/history.csv"));
}

TEST_F(ResumeTest, ACaseWhoseNameLooksLikeAnOptionCanBeGoneOnWith) {
  Shell("mv tangle.json ./-t.json");
  const ProgramResult result = Shell(
      "ulimit -f 128; \"$EMMY\" run --output out --quiet --steps 200 "
      "--set /output/every=1 --checkpoint-every 5 --checkpoint c -- -t.json");
  EXPECT_EQ(result.exit_status, 1);
  const size_t command = result.err.find("emmy run ./-t.json --output out");
  ASSERT_NE(command, std::string::npos) << result.err;
  const ProgramResult resumed = Shell(absl::StrReplaceAll(
      result.err.substr(command), {{"emmy run", "\"$EMMY\" run"}}));
  EXPECT_EQ(resumed.exit_status, 0) << resumed.err;
  EXPECT_EQ(Summary("out")["steps"], 200);
}

TEST_F(ResumeTest, ADiskTooFullForACheckpointKeepsTheLastOne) {
  const std::string run =
      "\"$EMMY\" run tangle.json --quiet --checkpoint-every 5 ";
  EXPECT_EQ(Shell(run + "--steps 10 --checkpoint c").exit_status, 0);
  const std::string before = Read("c");
  const ProgramResult result =
      Shell("ulimit -f 4; " + run + "--steps 20 --resume c");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.err,
              StartsWith("tangle.json: c: cannot be written: File too large\n"
                         "To go on: emmy run tangle.json --steps 20 "));
  EXPECT_TRUE(Read("c") == before);
  EXPECT_THAT(Files(), ElementsAre("c", "tangle.json"));
}

// The same on a file system that is full, not only to a file that may not
// grow: what fits no more, the temporary file of a checkpoint included, is
// gone.
TEST_F(ResumeTest, AFullFileSystemLeavesWhatItTakesToGoOn) {
  const std::string apart = "unshare --map-root-user --mount sh -c ";
  if (Shell(apart + "'mount -t tmpfs none .'").exit_status != 0) {
    GTEST_SKIP() << "no file system of one's own may be mounted here";
  }
  const std::string run =
      "\"$EMMY\" run tangle.json --output small --quiet --steps 200 "
      "--set /output/every=1 --checkpoint-every 5 ";
  Shell("mkdir small");
  // It goes with its name space: files are copied while it is there.
  const ProgramResult result =
      Shell("export EMMY; " + apart +
            "'mount -t tmpfs -o size=128k none small && {\n" + run +
            "--checkpoint small/c 2>first\necho $? >status; cp -r small full\n"
            "mount -o remount,size=8m small\n" +
            run + "--resume small/c 2>second; cp -r small parts; }'");
  ASSERT_EQ(result.err, "");
  EXPECT_EQ(Read("status"), "1\n");
  EXPECT_THAT(Read("first"), HasSubstr("No space left on device\n"));
  EXPECT_THAT(Read("first"), HasSubstr("\nTo go on: emmy run tangle.json "));
  const Checkpoint last = Decode("full/c");
  EXPECT_GT(last.state.step, 0);
  EXPECT_LT(last.state.step, 200);
  EXPECT_GE(Read("full/history.csv").size(), last.history->bytes);
  EXPECT_EQ(Read("second"), "");
  Run("run tangle.json --output whole --quiet --steps 200 "
      "--set /output/every=1");
  EXPECT_TRUE(Read("parts/history.csv") == Read("whole/history.csv"));
  EXPECT_EQ(Summary("parts"), Summary("whole"));
}

TEST_F(ResumeTest, ADeviceThatIsFullFailsClearly) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const ProgramResult result = Shell(
      "mkdir out; ln -s /dev/full out/history.csv; echo {} >out/summary.json; "
      "\"$EMMY\" run tangle.json --output out --quiet --checkpoint c");
  EXPECT_EQ(result.exit_status, 1);
  const std::string message =
      "out/history.csv: cannot be written: No space left on device";
  EXPECT_EQ(result.err, "tangle.json: " + message + "\n");
  EXPECT_THAT(Files(), ElementsAre("out", "tangle.json"));
  const json summary = json::parse(Read("out/summary.json"));
  EXPECT_EQ(summary.value("status", ""), "failed");
  EXPECT_EQ(summary.value("message", ""), message);
  EXPECT_EQ(summary.value("steps", -1), 0);
}

// A checkpoint of step 50, and what is said of attempts to go on from it.
class RefusedResumeTest : public ResumeTest {
 protected:
  RefusedResumeTest() {
    EXPECT_EQ(Run("run tangle.json --steps 50 --output out --quiet "
                  "--checkpoint c")
                  .exit_status,
              0);
  }

  // Runs with `arguments`; nothing may change.
  void ExpectRefused(const std::string& arguments, const std::string& message) {
    const std::string history = Read("out/history.csv");
    const std::string summary = Read("out/summary.json");
    const std::string checkpoint = Read("c");
    const ProgramResult result = Run("run tangle.json " + arguments);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(Read("out/history.csv") == history);
    EXPECT_TRUE(Read("out/summary.json") == summary);
    EXPECT_TRUE(Read("c") == checkpoint);
  }
};

TEST_F(RefusedResumeTest, OfAnotherCase) {
  ExpectRefused("--output out --resume c --set /name=other",
                "c: is a checkpoint of the case \"tangle\", this is \"other\"");
  ExpectRefused(
      "--output out --resume c --set /nodes/0/mass=30.000000000000004",
      "c: is a checkpoint of another version of the case");
}

TEST_F(RefusedResumeTest, OfADamagedFile) {
  const std::string good = Read("c");
  Write("c", good.substr(0, good.size() - 1));
  ExpectRefused("--output out --resume c", "c: the checkpoint is cut off");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 16);
  Write("c", flipped);
  ExpectRefused("--output out --resume c",
                "c: the checkpoint is damaged: its checksum is wrong");
  Write("c", absl::StrReplaceAll(good, {{"checkpoint/1\n", "checkpoint/2\n"}}));
  ExpectRefused("--output out --resume c",
                "c: has the format emmy-checkpoint/2; this version of emmy");
  Write("c", "");
  ExpectRefused("--output out --resume c", "c: is not a checkpoint");
}

TEST_F(RefusedResumeTest, OfAFileThatIsNone) {
  ExpectRefused("--output out --resume none",
                "none: cannot be opened: No such file or directory");
  ExpectRefused("--output out --resume out", "out: is not a regular file");
}

TEST_F(RefusedResumeTest, WithoutItsHistoryOrWithAnother) {
  ExpectRefused("--resume c", "c: is of a run with a history: --output must");
  const std::string good = Read("out/history.csv");
  Write("out/history.csv", good.substr(0, 100));
  ExpectRefused("--output out --resume c",
                "out/history.csv: cannot be continued: has 100 bytes");
  Write("out/history.csv", absl::StrReplaceAll(good, {{"\n30,", "\n31,"}}));
  ExpectRefused("--output out --resume c",
                "out/history.csv: cannot be continued: is not the history of "
                "the checkpoint, or was changed");
  ExpectRefused("--output other --resume c",
                "other/history.csv: cannot be continued: No such file");
}

TEST_F(RefusedResumeTest, BeyondItsEnd) {
  ExpectRefused("--output out --resume c --steps 49",
                "c: is of step 50, the run is to end at step 49");
}

TEST_F(RefusedResumeTest, OrACheckpointWouldBeLost) {
  ExpectRefused("--output out --checkpoint c",
                "c: exists: go on from it by --resume c, or remove it");
  ExpectRefused("--output out --checkpoint none/c",
                "none/c: cannot be written: No such file or directory");
  ExpectRefused("--output out --checkpoint-every 5",
                "--checkpoint-every needs --checkpoint or --resume");
}

class LastGoodStepTest : public ResumeTest {
 protected:
  // History and checkpoint end with the same step, which is returned, and hold
  // numbers only.
  int64_t LastStep() const {
    const std::string history = Read("out/history.csv");
    EXPECT_EQ(history.find("inf"), std::string::npos);
    EXPECT_EQ(history.find("nan"), std::string::npos);
    const Checkpoint last = Decode("c");
    EXPECT_EQ(last.history->bytes, history.size());
    const size_t row = history.rfind('\n', history.size() - 2) + 1;
    EXPECT_THAT(history.substr(row),
                StartsWith(absl::StrCat(last.state.step, ",")));
    return last.state.step;
  }
};

// Half a second is too long for this pendulum, though not everywhere.
TEST_F(LastGoodStepTest, IsWhereARunEndsThatFailsMidway) {
  const ProgramResult result =
      Run("run '" EMMY_SOURCE_DIR
          "/examples/simple_pendulum.json' --output out --checkpoint c "
          "--quiet --steps 1000 --set /integrator/time_step=0.5 "
          "--set /output/every=1");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err.find("To go on"), std::string::npos);
  const int64_t last = LastStep();
  EXPECT_GT(last, 0);
  EXPECT_THAT(result.err,
              HasSubstr(absl::StrCat(": step ", last + 1, " at t = ")));
  EXPECT_EQ(Summary("out")["steps"], last);
  EXPECT_EQ(Summary("out")["status"], "failed");
}

// A free fall so fast that its energy overflows while all coordinates are
// finite: what the step itself cannot notice.
TEST_F(LastGoodStepTest, IsKeptWhereTheEnergyOverflows) {
  Write("box.json", kBoxCase);
  const ProgramResult result =
      Run("run box.json --set '/gravity=[3e150, 0, 0]' --output out "
          "--checkpoint c --checkpoint-every 1 --quiet --steps 100");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_GT(LastStep(), 2);
  const std::string last = std::to_string(LastStep());
  EXPECT_THAT(result.err,
              StartsWith("box.json: step " + std::to_string(LastStep() + 1) +
                         " at t = 0.00" + last +
                         " s: energy or momentum is not finite; the state is "
                         "that of the last good step"));
  EXPECT_THAT(Read("out/summary.json"), HasSubstr("\"steps\": " + last + ","));
  EXPECT_THAT(Read("out/summary.json"), Not(HasSubstr("null")));
}

}  // namespace
}  // namespace emmy
