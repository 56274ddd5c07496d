// Each claim, at the quick level.

#include <gtest/gtest.h>

#include <vector>

#include "absl/strings/str_replace.h"
#include "verification/registry.h"

namespace emmy::verification {
namespace {

class ClaimsTest : public ::testing::TestWithParam<const Claim*> {};

TEST_P(ClaimsTest, Holds) {
  const Outcome outcome = RunClaim(*GetParam(), ClaimSetting());
  EXPECT_TRUE(outcome.pass)
      << GetParam()->sentence << "\n"
      << outcome.failure << "\nagain: " << GetParam()->command();
}

std::vector<const Claim*> Pointers() {
  std::vector<const Claim*> pointers;
  for (const Claim& claim : AllClaims()) pointers.push_back(&claim);
  return pointers;
}

INSTANTIATE_TEST_SUITE_P(
    Claims, ClaimsTest, ::testing::ValuesIn(Pointers()), [](const auto& claim) {
      return absl::StrReplaceAll(claim.param->id, {{"/", "_"}});
    });

}  // namespace
}  // namespace emmy::verification
