#include "emmy/base/build_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(BuildInfoTest, VersionHasThreeNumbers) {
  EXPECT_THAT(GetBuildInfo().version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(BuildInfoTest, CompilerHasNameAndVersion) {
  EXPECT_THAT(GetBuildInfo().compiler, MatchesRegex("(GNU|Clang) [0-9.]+"));
}

TEST(BuildInfoTest, FlagsShowThatContractionIsOff) {
  EXPECT_THAT(GetBuildInfo().flags, HasSubstr("-ffp-contract=off"));
}

}  // namespace
}  // namespace emmy
