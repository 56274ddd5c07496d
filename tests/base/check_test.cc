#include "emmy/base/check.h"

#include <gtest/gtest.h>

namespace emmy {
namespace {

TEST(CheckDeathTest, StopsAndShowsFileConditionAndValues) {
  const int index = 7;
  const int size = 3;
  EXPECT_DEATH(
      EMMY_CHECK(index < size, "index " << index << " of " << size),
      "check_test\\.cc:[0-9]+: check failed: index < size; values: index 7 of "
      "3");
}

TEST(CheckDeathTest, ShowsNumbersWithAllTheirDigits) {
  const double third = 1.0 / 3.0;
  EXPECT_DEATH(EMMY_CHECK(third > 1.0, third), "values: 0\\.3333333333333333");
}

TEST(CheckTest, AConditionThatHoldsNeitherStopsNorFormats) {
  int formatted = 0;
  EMMY_CHECK(formatted == 0, ++formatted);
  EXPECT_EQ(formatted, 0);
}

TEST(CheckTest, IsOneStatementAfterIf) {
  bool reached = false;
  // NOLINTBEGIN(google-readability-braces-around-statements)
  if (reached)
    EMMY_CHECK(false, "not reached");
  else
    reached = true;
  // NOLINTEND(google-readability-braces-around-statements)
  EXPECT_TRUE(reached);
}

}  // namespace
}  // namespace emmy
