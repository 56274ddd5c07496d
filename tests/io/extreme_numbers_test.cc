// Every number of a case replaced by extreme ones: it is refused with one line
// that says why, or the model is built and its first step is finite or fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "absl/strings/str_cat.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "tests/io/sample_case.h"

namespace emmy {
namespace {

using nlohmann::json;

class ExtremeNumbersTest : public ::testing::TestWithParam<const char*> {};

void ExpectOneLine(const absl::Status& status, int& refused) {
  ++refused;
  EXPECT_FALSE(status.message().empty());
  EXPECT_EQ(std::string(status.message()).find('\n'), std::string::npos);
}

bool AllFinite(const State& state) {
  return state.position.value.allFinite() && state.velocity.value.allFinite() &&
         state.strain.value.allFinite();
}

TEST_P(ExtremeNumbersTest, AreRefusedOrSteppedToNumbers) {
  const json flat = json::parse(kSampleCase).flatten();
  int numbers = 0;
  int refused = 0;
  int stepped = 0;
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number()) continue;
    ++numbers;
    const std::string setting = absl::StrCat(pointer, "=", GetParam());
    SCOPED_TRACE(setting);
    const absl::StatusOr<Case> read = ParseCase(kSampleCase, {setting});
    if (!read.ok()) {
      ExpectOneLine(read.status(), refused);
      continue;
    }
    absl::StatusOr<LoadedCase> loaded = BuildCase(*read);
    if (!loaded.ok()) {
      ExpectOneLine(loaded.status(), refused);
      continue;
    }
    EXPECT_TRUE(AllFinite(loaded->state));
    absl::StatusOr<EnergyMomentumIntegrator> integrator =
        EnergyMomentumIntegrator::Create(loaded->model,
                                         OptionsOf(read->integrator));
    if (!integrator.ok()) {
      ExpectOneLine(integrator.status(), refused);
      continue;
    }
    const StepReport report = integrator->Step(loaded->state);
    EXPECT_EQ(report.ok(), report.message.empty());
    EXPECT_TRUE(AllFinite(loaded->state)) << report.message;
    EXPECT_EQ(loaded->state.step, report.ok() ? 1 : 0);
    if (report.ok()) ++stepped;
  }
  // Else nothing was tried.
  EXPECT_GT(numbers, 80);
  EXPECT_GT(refused + stepped, numbers / 2);
}

INSTANTIATE_TEST_SUITE_P(
    EveryNumber, ExtremeNumbersTest,
    ::testing::Values("1e308", "-1e308", "1.7976931348623157e308", "1e154",
                      "5e-324", "-5e-324", "2.2250738585072014e-308", "-0.0",
                      "0", "9223372036854775807", "-9223372036854775808",
                      "18446744073709551615"),
    [](const auto& number) { return absl::StrCat("Number", number.index); });

}  // namespace
}  // namespace emmy
