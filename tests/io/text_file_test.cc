#include "emmy/io/text_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace emmy {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class TextFileTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) { return folder_ / name; }

  // Names of what is in the folder, sorted.
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  // A device of the kernel's "memory" kind, as /dev/full is one, under a name
  // that may be lost.
  bool MakeDevice(const std::string& name, unsigned minor) {
    const std::string path = Path(name);
    if (mknod(path.c_str(), S_IFCHR | 0600, makedev(1, minor)) != 0) {
      return false;
    }
    const int descriptor = open(path.c_str(), O_WRONLY);
    if (descriptor >= 0) close(descriptor);
    return descriptor >= 0;
  }

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
  EXPECT_THAT(Names(), ElementsAre("file"));
  EXPECT_EQ(*ReadTextFile(Path("file"), 100), "new");
}

TEST_F(TextFileTest, TouchesNoOtherFile) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  ASSERT_TRUE(WriteTextFile(Path("file.tmp"), "mine").ok());
  ASSERT_TRUE(WriteTextFile(Path("file"), "new").ok());
  EXPECT_THAT(Names(), ElementsAre("file", "file.tmp"));
  EXPECT_EQ(*ReadTextFile(Path("file.tmp"), 100), "mine");
}

// Of a program that was killed; one that still writes holds a lock.
TEST_F(TextFileTest, RemovesWhatWasLeftOfEarlierWritersOnly) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  const std::string left = "file.emmy-0123456789abcdef.tmp";
  const std::string held = "file.emmy-fedcba9876543210.tmp";
  const std::string other = "other.emmy-0123456789abcdef.tmp";
  for (const std::string& name : {left, held, other}) {
    ASSERT_TRUE(WriteTextFile(Path(name), "part").ok());
  }
  const int descriptor = open(Path(held).c_str(), O_WRONLY);
  ASSERT_EQ(flock(descriptor, LOCK_EX), 0);
  EXPECT_TRUE(WriteTextFile(Path("file"), "new").ok());
  close(descriptor);
  EXPECT_THAT(Names(), ElementsAre("file", held, other));
}

TEST_F(TextFileTest, TakesEveryNameThatTheSystemTakes) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  const std::string name(255, 'n');
  EXPECT_TRUE(WriteTextFile(Path(name), "text").ok());
  EXPECT_EQ(*ReadTextFile(Path(name), 100), "text");
}

TEST_F(TextFileTest, ReplacesWhatALinkLeadsTo) {
  ASSERT_TRUE(MakeDirectory(Path("a")).ok());
  fs::create_symlink("a/second", Path("first"));
  fs::create_symlink("file", Path("a/second"));
  for (const char* text : {"made", "replaced"}) {  // First there is no file.
    EXPECT_TRUE(WriteTextFile(Path("first"), text).ok());
    EXPECT_TRUE(fs::is_symlink(Path("first")));
    EXPECT_TRUE(fs::is_symlink(Path("a/second")));
    EXPECT_EQ(*ReadTextFile(Path("a/file"), 100), text);
  }
  fs::create_symlink("round", Path("round"));
  EXPECT_EQ(
      WriteTextFile(Path("round"), "").message(),
      Path("round") + ": cannot be written: Too many levels of symbolic links");
}

TEST_F(TextFileTest, RemovesAFileButNothingElse) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  ASSERT_TRUE(WriteTextFile(Path("file"), "old").ok());
  fs::create_symlink("file", Path("link"));
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  RemoveTextFile(Path("link"));
  RemoveTextFile(Path("pipe"));
  RemoveTextFile(Path("none"));
  EXPECT_THAT(Names(), ElementsAre("link", "pipe"));
}

TEST_F(TextFileTest, WritesIntoAPipeInsteadOfReplacingIt) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader(
      [&] { received = ReadTextFile(Path("pipe"), 100).value_or("nothing"); });
  // So that the reader ends even if nothing is written.
  const int descriptor = open(Path("pipe").c_str(), O_WRONLY);
  EXPECT_TRUE(WriteTextFile(Path("pipe"), "text").ok());
  EXPECT_TRUE(fs::is_fifo(Path("pipe")));
  close(descriptor);
  reader.join();
  EXPECT_EQ(received, "text");
}

TEST_F(TextFileTest, WritesToADeviceInsteadOfReplacingIt) {
  ASSERT_TRUE(MakeDirectory(Path("")).ok());
  constexpr unsigned kNull = 3;
  constexpr unsigned kFull = 7;
  if (!MakeDevice("null", kNull) || !MakeDevice("full", kFull)) {
    GTEST_SKIP() << "no device may be made here";
  }
  EXPECT_TRUE(WriteTextFile(Path("null"), "text").ok());
  EXPECT_EQ(WriteTextFile(Path("full"), "text").message(),
            Path("full") + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file(Path("null")));
  EXPECT_TRUE(fs::is_character_file(Path("full")));
  EXPECT_THAT(Names(), ElementsAre("full", "null"));
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
