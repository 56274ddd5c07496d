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

}  // namespace
}  // namespace emmy
