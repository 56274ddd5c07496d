#include "verification/timing/timing_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy::verification {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(TimingPageTest, CountsTargetsInItsTitle) {
  TimingPageParts parts;
  parts.report = "| a | 1 | <= 2 | met | set |\n";
  parts.peers = "| b | 3 | <= 2 | **missed** | set |\n";
  EXPECT_THAT(TimingPage(TimingRun(), parts), HasSubstr("1 of 2 targets met"));
}

TEST(TimingPageTest, ShowsFiguresWithTheirData) {
  TimingPageParts parts;
  EXPECT_THAT(TimingPage(TimingRun(), parts), Not(HasSubstr("<figure>")));
  parts.figures = {{"growth", "Growth", "times < sizes", "A curve.",
                    "<svg></svg>", "size,time\n"}};
  EXPECT_THAT(TimingPage(TimingRun(), parts),
              AllOf(HasSubstr("<section id=\"growth\">"),
                    HasSubstr("alt=\"times &lt; sizes\""),
                    HasSubstr("download=\"growth.csv\""),
                    HasSubstr("data:image/svg+xml")));
}

}  // namespace
}  // namespace emmy::verification
