// What a user gets from `emmy run` and `emmy check`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "tests/cli/program.h"

namespace emmy {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class RunTest : public ProgramTest {
 protected:
  RunTest() { Write("box.json", kBoxCase); }

  // The fields of the column `column` (from 0) of out/history.csv.
  std::vector<std::string> Column(size_t column) const {
    std::vector<std::string> fields;
    const std::vector<std::string> lines =
        absl::StrSplit(Read("out/history.csv"), '\n', absl::SkipEmpty());
    for (size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> row = absl::StrSplit(lines[i], ',');
      fields.push_back(row[column]);
    }
    return fields;
  }
};

TEST_F(RunTest, PrintsTheSummaryAndWritesNothingWithoutOutput) {
  const ProgramResult result = Run("run box.json");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.err, "");
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["format"], "emmy-summary/1");
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["steps"], 10);
  EXPECT_EQ(summary["degrees_of_freedom"], 12);
  EXPECT_LT(summary["invariants"]["energy"]["max_relative_error"], 1e-15);
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

// A terminal would take them for commands; the summary has the name as it is.
TEST_F(RunTest, ControlCharactersOfTheCasesNameAreShownAsSuch) {
  const std::string names =
      R"( --set '/name="a\u001b[31m\u009b\nb"' --set '/purpose="\u0007."')";
  const ProgramResult check = Run("check box.json" + names);
  EXPECT_EQ(check.exit_status, 0);
  EXPECT_THAT(check.out, StartsWith(R"(a\u001b[31m\u009b\u000ab)"
                                    "\n  \\u0007.\n"));
  const ProgramResult run = Run("run box.json --output out" + names);
  EXPECT_EQ(run.exit_status, 0);
  EXPECT_THAT(run.out, StartsWith(R"(a\u001b[31m\u009b\u000ab: 10 steps)"));
  EXPECT_EQ(json::parse(Read("out/summary.json"))["case"],
            "a\x1b[31m\u009b\nb");
}

TEST_F(RunTest, WritesHistoryAndSummaryIntoTheOutputFolder) {
  const ProgramResult result = Run("run box.json --output out");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("box: 10 steps to 0.01 s"));
  EXPECT_THAT(result.out,
              HasSubstr("Wrote out/history.csv and out/summary.json\n"));
  EXPECT_EQ(Column(0).size(), 11u);
  EXPECT_EQ(json::parse(Read("out/summary.json"))["steps"], 10);
}

TEST_F(RunTest, MakesTheOutputFolderAndItsParents) {
  EXPECT_EQ(Run("run box.json --output a/b/c").exit_status, 0);
  EXPECT_THAT(Read("a/b/c/summary.json"), HasSubstr("emmy-summary/1"));
}

TEST_F(RunTest, IsSilentIfAskedTo) {
  const ProgramResult result = Run("run box.json --output out --quiet");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(RunTest, WritesEveryNthStepAndTheLast) {
  EXPECT_EQ(Run("run box.json --output out --set /output/every=4").exit_status,
            0);
  EXPECT_THAT(Column(0), ElementsAre("0", "4", "8", "10"));
}

TEST_F(RunTest, StepsReplaceTheDuration) {
  EXPECT_EQ(Run("run box.json --output out --steps 3").exit_status, 0);
  EXPECT_THAT(Column(1), ElementsAre("0", "0.001", "0.002",
                                     ::testing::StartsWith("0.003")));
  EXPECT_EQ(Run("run box.json --output out --steps 0").exit_status, 0);
  EXPECT_THAT(Column(0), ElementsAre("0"));
}

TEST_F(RunTest, OverridesMayBeRepeated) {
  const ProgramResult result =
      Run("run --set /integrator/duration=2e-3 box.json --set /name=other");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(json::parse(result.out)["steps"], 2);
  EXPECT_EQ(json::parse(result.out)["case"], "other");
}

TEST_F(RunTest, GivesTheSameHistoryEachTime) {
  EXPECT_EQ(Run("run box.json --output out").exit_status, 0);
  const std::string first = Read("out/history.csv");
  EXPECT_EQ(Run("run box.json --output out").exit_status, 0);
  EXPECT_EQ(Read("out/history.csv"), first);
}

// Steps of 100 s with a body that turns by 99 rad in each cannot converge.
// 96 x 96 nodes are enough to be shared out (VectorBlocks), and their factor
// has more than 8 MiB (SupernodalSolve::kLargeFactor): 2.4 million entries.
TEST_F(RunTest, ThreadsChangeNoBitOfTheHistory) {
  EXPECT_EQ(Run("generate net --size 96 --output net.json").exit_status, 0);
  EXPECT_EQ(Run("run net.json --steps 3 --quiet --output alone").exit_status,
            0);
  EXPECT_EQ(Run("run net.json --steps 3 --quiet --threads 2 --output shared")
                .exit_status,
            0);
  // Not EXPECT_EQ: a failure would print both files.
  EXPECT_TRUE(Read("alone/history.csv") == Read("shared/history.csv"));
}

TEST_F(RunTest, AFailedRunKeepsItsHistoryAndSaysSo) {
  const ProgramResult result =
      Run("run box.json --output out --steps 5 --set /integrator/time_step=100 "
          "--set /rigid_bodies/0/penalty=1e14");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.err, StartsWith("box.json: step "));
  const json summary = json::parse(Read("out/summary.json"));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ("box.json: " + summary["message"].get<std::string>() + "\n",
            result.err);
  EXPECT_EQ(Column(0).size(), summary["steps"].get<size_t>() + 1);
}

// The frame of a soft body may become its mirror image in a large step: the run
// ends there, whatever it writes, with the state before.
TEST_F(RunTest, ABodyThatTurnsInsideOutEndsTheRunAtTheLastGoodStep) {
  const std::string soft =
      "run box.json --steps 40 --set /rigid_bodies/0/penalty=1 "
      "--set /integrator/time_step=1 ";
  const ProgramResult alone = Run(soft);
  EXPECT_EQ(alone.exit_status, 1);
  const json summary = json::parse(alone.out);
  EXPECT_EQ(summary["status"], "failed");
  const int last = summary["steps"];
  EXPECT_THAT(alone.err,
              HasSubstr("step " + std::to_string(last + 1) +
                        " at t = " + std::to_string(last) +
                        " s: body \"box\" has turned inside out: the "
                        "determinant of its gradient vectors must be > 0"));
  for (const int every : {1, 7, 40}) {
    const std::string output = "out_" + std::to_string(every);
    const ProgramResult result =
        Run(soft + "--output " + output + " --checkpoint " + output +
            ".checkpoint --set /output/every=" + std::to_string(every));
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_THAT(result.err, Not(HasSubstr("--resume")));
    EXPECT_EQ(json::parse(Read(output + "/summary.json"))["steps"], last);
    const std::string history = Read(output + "/history.csv");
    const size_t row = history.rfind('\n', history.size() - 2) + 1;
    EXPECT_THAT(history.substr(row), StartsWith(std::to_string(last) + ","));
  }
}

TEST_F(RunTest, AFullDiskEndsTheRunAfterTheLastWholeRow) {
  const ProgramResult result = Shell(
      "ulimit -f 4; \"$EMMY\" run box.json --output out --quiet "
      "--steps 1000");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err,
            "box.json: out/history.csv: cannot be written: File too large\n");
  const std::string history = Read("out/history.csv");
  EXPECT_EQ(history.back(), '\n');
  const json summary = json::parse(Read("out/summary.json"));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(Column(0).back(), std::to_string(Column(0).size() - 1));
  EXPECT_LT(Column(0).size(), 1000u);
}

// Starts a run that would take hours, and ends it when `condition` holds.
std::string RunUntil(const std::string& condition) {
  return "\"$EMMY\" run box.json --output out --steps 1000000000 "
         "--set /output/every=100 &\n"
         "until " +
         condition + "; do sleep 0.1; done\nkill -TERM $!\nwait $!\n";
}

TEST_F(RunTest, AnInterruptEndsTheRunAfterAWholeRow) {
  const ProgramResult result = Shell(RunUntil("[ -s out/history.csv ]"));
  EXPECT_EQ(result.exit_status, 3);
  EXPECT_THAT(result.err, StartsWith("box.json: interrupted after step "));
  const json summary = json::parse(Read("out/summary.json"));
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(Column(0).back(), std::to_string(summary["steps"].get<int64_t>()));
}

// A run that waits for a reader of its history, so that it cannot end by
// itself: the first two signals are one wish, the third is another.
TEST_F(RunTest, OnlyALaterSignalEndsTheRunAtOnce) {
  const ProgramResult result = Shell(
      "mkdir out; mkfifo out/history.csv\n"
      "\"$EMMY\" run box.json --output out &\n"
      "sleep 0.5; kill -TERM $!; sleep 0.5; kill -TERM $!; sleep 0.2\n"
      "kill -0 $! && echo runs\n"
      "sleep 2; kill -TERM $!\nwait $!\n");
  EXPECT_EQ(result.out, "runs\n");
  EXPECT_EQ(result.exit_status, 128 + 15);
}

TEST_F(RunTest, WritesNoProgressWhereThereIsNoTerminal) {
  const ProgramResult result = Shell(RunUntil("sleep 1.5"));
  EXPECT_THAT(result.err, StartsWith("box.json: interrupted after step "));
}

TEST_F(RunTest, ShowsProgressOnATerminalAndRemovesItAtTheEnd) {
  // A chroot without /dev/pts has no terminals to give.
  if (Shell("script -qfc true /dev/null").exit_status != 0) {
    GTEST_SKIP() << "no pseudo-terminal on this machine";
  }
  Write("go.sh", RunUntil("grep -q left terminal"));
  Shell("export EMMY TERM=xterm; script -qfc 'sh go.sh' terminal");
  const std::string terminal = Read("terminal");
  EXPECT_THAT(terminal, HasSubstr("%  step "));
  EXPECT_THAT(terminal, HasSubstr(" of 1000000000  "));
  const size_t last_bar = terminal.rfind(" left");
  EXPECT_THAT(terminal.substr(last_bar),
              StartsWith(" left\033[K\r\033[Kbox: "));  // Then the report.
}

class CheckTest : public ProgramTest {
 protected:
  CheckTest() { Write("box.json", kBoxCase); }
};

TEST_F(CheckTest, SaysWhatTheModelIs) {
  const ProgramResult result = Run("check box.json --set /output/every=4");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, R"(box
Gravity: (0, 0, 0) m/s^2
Rigid bodies: 1
  box: ancf, mass 16200 kg, principal inertia (6750, 13500, 17550) kg m^2
    turns by 0.00099 rad a step (0.989949 rad/s)
    penalty 1e+10 Pa: fastest strain 7.45e+03 rad/s, 1.19 periods a step; starts undeformed
Degrees of freedom: 12
Integrator: energy_momentum, order 2, 10 steps of 0.001 s to 0.01 s, tolerance round_off
Output: every 4 steps, 4 rows
Conserved: energy yes, momentum yes, angular momentum yes
)");
  EXPECT_THAT(Files(), ElementsAre("box.json"));
}

TEST_F(CheckTest, AcceptsEveryExample) {
  const ProgramResult result =
      Shell("for file in '" EMMY_SOURCE_DIR
            "'/examples/*.json; do \"$EMMY\" check \"$file\" || exit 1; done");
  EXPECT_EQ(result.exit_status, 0) << result.err;
}

// Ten to seventy times the step that follows its motion. What the joint forces
// work where the points they join do not yet move alike changed the energy by
// 1e-11 and 2e-10 when it was not judged; the bound is that promised of a run.
TEST_F(RunTest, AMechanismInStepsTooLargeForItKeepsItsEnergy) {
  for (const char* time_step : {"1e-4", "3.2e-4", "7e-4"}) {
    const ProgramResult result = Shell(absl::StrCat(
        "\"$EMMY\" run '" EMMY_SOURCE_DIR "/examples/andrews_squeezer.json' ",
        "--quiet --steps 80 --set /integrator/time_step=", time_step));
    const json summary = json::parse(result.out);
    EXPECT_EQ(summary["steps"], 80) << result.err;
    EXPECT_LE(summary["invariants"]["energy"]["max_relative_error"], 1e-14)
        << time_step;
  }
}

class HelpTest : public ProgramTest {};

TEST_F(HelpTest, EveryCommandHasHelpWithExamples) {
  for (const char* arguments :
       {"--help", "run --help", "check --help", "generate --help"}) {
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.exit_status, 0) << arguments;
    EXPECT_EQ(result.err, "") << arguments;
    EXPECT_THAT(result.out, HasSubstr("Examples:\n  emmy ")) << arguments;
  }
}

TEST_F(HelpTest, FitsATerminal) {
  for (const char* arguments :
       {"--help", "run --help", "check --help", "generate --help"}) {
    const std::vector<std::string> lines =
        absl::StrSplit(Run(arguments).out, '\n');
    for (const std::string& line : lines) {
      EXPECT_LE(line.size(), 80u) << line;
    }
  }
}

// What is printed waits in a buffer, and is lost where that is emptied last.
TEST_F(HelpTest, StandardOutputThatTakesNothingIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const ProgramResult result = Shell("\"$EMMY\" --version > /dev/full");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output could not be written"));
}

TEST_F(HelpTest, VersionNamesProgramAndBuild) {
  const ProgramResult result = Run("--version");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_THAT(result.out, StartsWith("emmy "));
  EXPECT_THAT(result.out, HasSubstr("\nbuilt with "));
}

}  // namespace
}  // namespace emmy
