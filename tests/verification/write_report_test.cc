#include "verification/report/write_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/verification/sample_outcome.h"
#include "verification/report/environment.h"

namespace emmy::verification {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class WriteReportTest : public ::testing::Test {
 protected:
  WriteReportTest() {
    const char* const path = std::getenv("PATH");
    if (path != nullptr) path_ = path;
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  ~WriteReportTest() override { setenv("PATH", path_.c_str(), 1); }

  std::string Text(const char* name) const {
    std::ifstream in(directory_ / name);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  std::string path_;
  // Its own for each test: they may run at the same time.
  const fs::path directory_ =
      fs::path(::testing::TempDir()) /
      (std::string("emmy_report_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const Claim claim_ = SampleClaim("group/name");
};

TEST_F(WriteReportTest, WritesEveryFileAndDrawsOnSeveralThreads) {
  std::vector<Figure> figures(5, SampleFigure());
  for (size_t i = 0; i < figures.size(); ++i) {
    figures[i].name += std::to_string(i);
  }
  const auto messages = WriteReport({SampleOutcome(claim_, {0.5}, figures)},
                                    SampleEnvironment(), directory_.string());
  ASSERT_TRUE(messages.ok()) << messages.status();
  if (!messages->empty()) GTEST_SKIP() << messages->front();
  for (const char* name : {"index.html", "report.json", "junit.xml",
                           "sample0.svg", "sample4.csv", "sample4.gp"}) {
    EXPECT_THAT(Text(name), Not(IsEmpty())) << name;
  }
  EXPECT_THAT(Text("index.html"), Not(HasSubstr("Not drawn")));
}

TEST_F(WriteReportTest, WithoutGnuplotThePageHasTheDataAndNoOldImage) {
  std::ofstream(directory_ / "sample.svg") << "<svg>old</svg>";
  setenv("PATH", directory_.c_str(), 1);
  const auto messages =
      WriteReport({SampleOutcome(claim_, {0.5}, {SampleFigure()})},
                  SampleEnvironment(), directory_.string());
  ASSERT_TRUE(messages.ok()) << messages.status();
  EXPECT_THAT(*messages, ElementsAre(HasSubstr("sample.svg: not drawn")));
  EXPECT_FALSE(fs::exists(directory_ / "sample.svg"));
  EXPECT_THAT(Text("index.html"),
              AllOf(HasSubstr("Not drawn"), Not(HasSubstr("<img")),
                    HasSubstr("download=\"sample.csv\"")));
}

TEST_F(WriteReportTest, FailsWhereNothingCanBeWritten) {
  EXPECT_FALSE(
      WriteReport({}, SampleEnvironment(), (directory_ / "none").string())
          .ok());
}

TEST(EnvironmentTest, SaysWhatThisMachineIs) {
  const Environment environment = DescribeEnvironment({"emmy", "verify"});
  EXPECT_THAT(
      environment.date,
      ::testing::MatchesRegex("[0-9]+-[0-9]+-[0-9]+T[0-9]+:[0-9]+:[0-9]+Z"));
  EXPECT_THAT(environment.processor, Not(IsEmpty()));
  EXPECT_THAT(environment.system, HasSubstr("Linux"));
  EXPECT_THAT(environment.build.compiler, Not(IsEmpty()));
  EXPECT_EQ(environment.command, "emmy verify");
}

TEST(ShellCommandTest, QuotesWhatAShellWouldSplitOrExpand) {
  EXPECT_EQ(ShellCommand({"emmy", "a/b_c-1.json", "it's $HOME", ""}),
            "emmy a/b_c-1.json 'it'\\''s $HOME' ''");
}

}  // namespace
}  // namespace emmy::verification
