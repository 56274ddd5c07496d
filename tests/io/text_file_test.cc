#include "emmy/io/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace emmy {
namespace {

namespace fs = std::filesystem;

class TextFileTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) { return folder_ / name; }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) /
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(TextFileTest, ReadsWhatWasWritten) {
  ASSERT_TRUE(MakeDirectory(Path("a/b")).ok());
  const std::string text("line\n\0byte\xff", 11);
  ASSERT_TRUE(WriteTextFile(Path("a/b/file"), text).ok());
  const absl::StatusOr<std::string> back = ReadTextFile(Path("a/b/file"), 100);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, text);
}

TEST_F(TextFileTest, LeavesNoTemporaryFile) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  ASSERT_TRUE(WriteTextFile(Path("file"), "old").ok());
  ASSERT_TRUE(WriteTextFile(Path("file"), "new").ok());
  EXPECT_EQ(
      std::distance(fs::directory_iterator(folder_), fs::directory_iterator()),
      1);
  EXPECT_EQ(*ReadTextFile(Path("file"), 100), "new");
}

TEST_F(TextFileTest, ReadsNoMoreThanTheLimit) {
  const absl::StatusOr<std::string> zeros = ReadTextFile("/dev/zero", 1 << 20);
  EXPECT_EQ(zeros.status().message(), "larger than 1 MiB");
}

TEST_F(TextFileTest, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(ReadTextFile(Path("none"), 100).status().message(),
            "cannot be opened: No such file or directory");
  EXPECT_EQ(ReadTextFile(::testing::TempDir(), 100).status().message(),
            "is a directory, must be a file");
}

TEST_F(TextFileTest, SaysWhyAFileCannotBeWritten) {
  EXPECT_EQ(
      WriteTextFile(Path("none/file"), "").message(),
      Path("none/file") + ": cannot be written: No such file or directory");
}

TEST_F(TextFileTest, SaysThatAFileIsInTheWayOfADirectory) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  ASSERT_TRUE(WriteTextFile(Path("file"), "").ok());
  EXPECT_EQ(MakeDirectory(Path("file")).message(),
            Path("file") +
                ": cannot be made a directory: a file of that name exists");
  EXPECT_EQ(MakeDirectory(Path("file/sub")).message(),
            Path("file/sub") + ": cannot be made a directory: Not a directory");
}

}  // namespace
}  // namespace emmy
