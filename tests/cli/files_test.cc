// Which files a command writes, and that it loses no other.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "tests/cli/program.h"

namespace emmy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FilesTest : public ProgramTest {
 protected:
  FilesTest() { Write("box.json", kBoxCase); }

  // Names of all files and folders, and what is in the files.
  std::string Tree() const {
    return Shell("find . | sort; find . -type f | sort | xargs sha256sum").out;
  }

  // With exit status 2 and nothing written, not even a folder.
  void ExpectRefused(const std::string& arguments, const std::string& message) {
    SCOPED_TRACE(arguments);
    const std::string before = Tree();
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_THAT(result.err, StartsWith(message));
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(Tree(), before);
  }
};

TEST_F(FilesTest, ACheckpointMustNotBeAnotherFileOfTheRun) {
  Shell("ln -s o/history.csv link");
  for (const char* name :
       {"o/history.csv", "o/summary.json", "./o/../o//history.csv", "link"}) {
    ExpectRefused(absl::StrCat("run box.json --output o --checkpoint ", name),
                  absl::StrCat(name, ": must not be the "));
  }
  ExpectRefused("run box.json --output o --checkpoint o/history.csv",
                "o/history.csv: must not be the history and the checkpoint at "
                "once\n");
  ExpectRefused("run box.json --checkpoint ./box.json",
                "./box.json: must not be the case and the checkpoint at once");
}

TEST_F(FilesTest, ResultsMustNotReplaceTheCase) {
  Shell("mkdir o; cp box.json o/summary.json; ln box.json o/history.csv");
  ExpectRefused("run o/summary.json --output o",
                "o/summary.json: must not be the case and the summary at once");
  ExpectRefused("run box.json --output o",
                "o/history.csv: must not be the case and the history at once");
}

TEST_F(FilesTest, ResultsMustNotReplaceTheCheckpointToGoOnFrom) {
  Run("run box.json --steps 5 --output o --checkpoint c --quiet");
  Shell("cp c o/summary.json");
  for (const char* checkpoint : {"", " --checkpoint d"}) {
    ExpectRefused(absl::StrCat("run box.json --output o --resume "
                               "o/summary.json",
                               checkpoint),
                  "o/summary.json: must not be the summary and the checkpoint "
                  "to go on from at once");
  }
}

TEST_F(FilesTest, ACheckpointMayBeNamedTwice) {
  Run("run box.json --steps 5 --checkpoint c --quiet");
  const ProgramResult result =
      Run("run box.json --quiet --resume c --checkpoint ./c");
  EXPECT_EQ(result.exit_status, 0) << result.err;
}

TEST_F(FilesTest, ARefusedRunLeavesNoFolder) {
  ExpectRefused("run box.json --output new/deep --checkpoint none/c",
                "none/c: cannot be written: No such file or directory");
  ExpectRefused("run box.json --output new/deep --checkpoint new",
                "new: cannot be written: Is a directory");
  ExpectRefused("run box.json --output new/" + std::string(300, 'x'), "new/xx");
  Run("run box.json --steps 5 --output o --checkpoint c --quiet");
  ExpectRefused("run box.json --output new/deep/ --resume c",
                "new/deep//history.csv: cannot be continued: No such file");
}

// Its summary beside an empty history would be taken for that of this run.
TEST_F(FilesTest, AHistoryThatCannotBeBegunLeavesNoSummaryOfAnEarlierRun) {
  Run("run box.json --output o --quiet");
  const ProgramResult result =
      Shell("(ulimit -f 0; \"$EMMY\" run box.json --output o --quiet)");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(Shell("ls o").out, "history.csv\n");
  EXPECT_EQ(Read("o/history.csv"), "");
}

TEST_F(FilesTest, AHistoryThatCannotBeOpenedLeavesEverythingAsItWas) {
  Run("run box.json --output o --quiet");
  Shell("mv o/history.csv o/kept; mkdir o/history.csv");
  ExpectRefused("run box.json --output o",
                "o/history.csv: cannot be opened: Is a directory");
}

TEST_F(FilesTest, AnEmptyNameIsNotLeftOut) {
  for (const char* arguments :
       {"run '' ", "check '' ", "run box.json --output ''",
        "run box.json --checkpoint ''", "run box.json --resume ''",
        "generate chain --size 2 --output ''", "verify --output ''"}) {
    SCOPED_TRACE(arguments);
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_THAT(result.err, HasSubstr(": must be a name, got an empty one\n"));
    EXPECT_THAT(Files(), ElementsAre("box.json"));
  }
  ExpectRefused("run box.json --set ''",
                "box.json: --set: must have the form /json/pointer=value, got "
                "\"\"");
}

TEST_F(FilesTest, ASettingMustBeUtf8) {
  ExpectRefused("run box.json --output o --set \"$(printf '/name=Ma\\337e')\"",
                "box.json: --set: must be UTF-8, got \"/name=Ma");
  ExpectRefused("run box.json --output o --set \"$(printf '/Ma\\337e=1')\"",
                "box.json: --set: must be UTF-8, got \"/Ma");
}

// A file name may be any bytes; the summary of what failed names it.
TEST_F(FilesTest, AFileNameNeedNotBeUtf8) {
  const ProgramResult result = Shell(
      "ulimit -f 4; \"$EMMY\" run box.json --output \"$(printf 'Ma\\337e')\" "
      "--quiet --steps 1000; cat Ma*/summary.json");
  EXPECT_THAT(result.err, HasSubstr("/history.csv: cannot be written: File"));
  EXPECT_THAT(result.out, HasSubstr("\"message\": \"Ma\xEF\xBF\xBD"));
}

TEST_F(FilesTest, ACaseWhoseNameEndsInTmpIsKept) {
  Shell("mv box.json mine.tmp");
  EXPECT_EQ(Run("run mine.tmp --quiet --checkpoint mine").exit_status, 0);
  EXPECT_EQ(Read("mine.tmp"), kBoxCase);
  EXPECT_THAT(Files(), ElementsAre("mine", "mine.tmp"));
}

TEST_F(FilesTest, WhatAKilledRunLeftIsRemoved) {
  Write("c.emmy-0123456789abcdef.tmp", "part of a checkpoint");
  EXPECT_EQ(Run("run box.json --quiet --checkpoint c").exit_status, 0);
  EXPECT_THAT(Files(), ElementsAre("box.json", "c"));
}

TEST_F(FilesTest, AModelCanBeWrittenToStandardOutputByName) {
  const std::string text = Run("generate chain --size 2").out;
  // As /dev/stdout is, which a program at fault would replace.
  Shell("ln -s /proc/self/fd/1 stdout");
  const std::string generate =
      "\"$EMMY\" generate chain --size 2 --output stdout";
  EXPECT_EQ(Shell(generate + " | cat").out, text);
  // Not in place of what is in the file.
  EXPECT_EQ(
      Shell("echo before >f; { " + generate + "; echo after; } >>f; cat f").out,
      "before\n" + text + "after\n");
}

TEST_F(FilesTest, AModelIsWrittenToADeviceNotInPlaceOfIt) {
  // Never the real ones: a program at fault would replace them.
  if (Shell("mknod full c 1 7 && : <full").exit_status != 0) {
    GTEST_SKIP() << "no device may be made here";
  }
  const ProgramResult result = Run("generate chain --size 2 --output full");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err, "full: cannot be written: No space left on device\n");
  EXPECT_EQ(Shell("test -c full").exit_status, 0);
}

// The first file opened would otherwise be standard error to the program.
TEST_F(FilesTest, MessagesGoIntoNoFileWhereAStreamIsClosed) {
  const std::string run =
      "run box.json --output out --steps 5 --set /integrator/time_step=100 "
      "--set /rigid_bodies/0/penalty=1e14";
  EXPECT_THAT(Run(run).err, StartsWith("box.json: step "));
  const std::string history = Read("out/history.csv");
  for (const char* closed : {"2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    SCOPED_TRACE(closed);
    EXPECT_EQ(Shell(absl::StrCat("\"$EMMY\" ", run, " ", closed)).exit_status,
              1);
    EXPECT_EQ(Read("out/history.csv"), history);
  }
}

TEST_F(FilesTest, AClosedStandardOutputIsAnErrorWhereSomethingIsPrinted) {
  const ProgramResult result = Shell("\"$EMMY\" run box.json >&-");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output could not be written"));
  EXPECT_EQ(Shell("\"$EMMY\" run box.json --output o --quiet >&-").exit_status,
            0);
}

// The end by a signal that it would be otherwise says nothing.
TEST_F(FilesTest, AReaderThatIsGoneIsAnErrorWhereSomethingIsPrinted) {
  for (const char* arguments :
       {"run box.json", "generate chain --size 2", "verify --list", "--help",
        "run --help", "--version"}) {
    SCOPED_TRACE(arguments);
    const ProgramResult result = Shell(absl::StrCat(
        "rm -f gone\n{ until [ -e gone ]; do sleep 0.02; done\n"
        "\"$EMMY\" ",
        arguments, "; echo $? >status; } | { exec <&-; touch gone; }"));
    EXPECT_EQ(Read("status"), "1\n");
    EXPECT_EQ(result.err,
              "emmy: standard output could not be written; what was printed is "
              "lost\n");
  }
}

TEST_F(FilesTest, AReaderOfTheHistoryThatGoesAwayEndsTheRun) {
  const ProgramResult result = Shell(
      "mkdir o; mkfifo o/history.csv; head -n 1 o/history.csv >first &\n"
      "\"$EMMY\" run box.json --output o --quiet --steps 1000000");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err,
            "box.json: o/history.csv: cannot be written: Broken pipe\n");
  EXPECT_THAT(Read("o/summary.json"), HasSubstr("\"status\": \"failed\""));
}

}  // namespace
}  // namespace emmy
