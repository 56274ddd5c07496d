#include "verification/runs/extrapolation.h"

#include <gtest/gtest.h>

#include "absl/status/status.h"

namespace emmy::verification {
namespace {

TEST(ExtrapolateTest, RemovesTheErrorsOfSecondAndFourthOrder) {
  const auto result = Extrapolate<double>(
      0.5, [](double h) { return 3.0 + 5.0 * h * h + 7.0 * h * h * h * h; });
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->plain[0], 3.0 + 5.0 / 4.0 + 7.0 / 16.0);
  EXPECT_EQ(result->plain[2], 3.0 + 5.0 / 64.0 + 7.0 / 4096.0);
  // What is left of h⁴: −¼ of it, from h and h/2.
  EXPECT_NEAR(result->coarse, 3.0 - 7.0 / 64.0, 1e-15);
  EXPECT_NEAR(result->fine, 3.0 - 7.0 / 1024.0, 1e-15);
  EXPECT_NEAR(result->finest, 3.0, 1e-15);
}

TEST(ExtrapolateTest, EndsWithTheFirstStepThatFails) {
  int calls = 0;
  const auto result =
      Extrapolate<double>(1.0, [&calls](double h) -> absl::StatusOr<double> {
        ++calls;
        if (h < 1.0) return absl::InternalError("too small");
        return h;
      });
  EXPECT_EQ(result.status().message(), "too small");
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace emmy::verification
