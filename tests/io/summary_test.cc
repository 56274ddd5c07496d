#include "emmy/io/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "emmy/base/build_info.h"

namespace emmy {
namespace {

RunSummary Sample() {
  RunSummary summary;
  summary.case_name = "box";
  summary.status = RunStatus::kCompleted;
  summary.steps = 10000;
  summary.time = 10.0;
  summary.wall_seconds = 0.5;
  summary.degrees_of_freedom = 15;
  summary.energy = {.initial = 3.0,
                    .final = 3.0,
                    .max_error = 1e-15,
                    .scale = 4.0,
                    .conserved = true};
  summary.momentum = {.initial = Vector3d(1, 2, 3),
                      .final = Vector3d(1, 2, 4),
                      .max_error = 1.0,
                      .scale = 5.0,
                      .conserved = false};
  summary.mean_iterations = 4.5;
  summary.max_iterations = 6;
  return summary;
}

TEST(SummaryTest, HasEveryFieldOfTheFormat) {
  const BuildInfo build = GetBuildInfo();
  nlohmann::json expected = nlohmann::json::parse(R"({
    "format": "emmy-summary/1", "case": "box", "status": "completed",
    "steps": 10000, "time": 10.0, "wall_seconds": 0.5,
    "degrees_of_freedom": 15,
    "invariants": {
      "energy": {"initial": 3.0, "final": 3.0, "max_error": 1e-15,
                 "scale": 4.0, "max_relative_error": 2.5e-16,
                 "conserved": true},
      "momentum": {"initial": [1.0, 2.0, 3.0], "final": [1.0, 2.0, 4.0],
                   "max_error": 1.0, "scale": 5.0, "max_relative_error": 0.2,
                   "conserved": false},
      "angular_momentum": {"initial": [0.0, 0.0, 0.0],
                           "final": [0.0, 0.0, 0.0], "max_error": 0.0,
                           "scale": 0.0, "max_relative_error": 0.0,
                           "conserved": true}},
    "newton": {"mean_iterations": 4.5, "max_iterations": 6}})");
  expected["build"] = {{"version", build.version},
                       {"compiler", build.compiler},
                       {"flags", build.flags}};
  EXPECT_EQ(nlohmann::json::parse(WriteSummary(Sample())), expected);
}

TEST(SummaryTest, SaysWhyARunFailed) {
  RunSummary summary = Sample();
  summary.status = RunStatus::kFailed;
  summary.message = "step 3: no";
  const nlohmann::json json = nlohmann::json::parse(WriteSummary(summary));
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["message"], "step 3: no");
}

TEST(SummaryTest, HasAMessageThatIsUtf8WhateverItNames) {
  RunSummary summary = Sample();
  summary.message =
      "Ma\xDF"
      "e/history.csv: no";
  const nlohmann::json json = nlohmann::json::parse(WriteSummary(summary));
  EXPECT_EQ(json["message"],
            "Ma\xEF\xBF\xBD"
            "e/history.csv: no");
}

TEST(SummaryTest, HasNullWhereANumberIsNotFinite) {
  RunSummary summary = Sample();
  summary.energy.final = std::numeric_limits<double>::quiet_NaN();
  summary.energy.max_error = std::numeric_limits<double>::infinity();
  const nlohmann::json json = nlohmann::json::parse(WriteSummary(summary));
  EXPECT_TRUE(json["invariants"]["energy"]["final"].is_null());
  EXPECT_TRUE(json["invariants"]["energy"]["max_error"].is_null());
}

}  // namespace
}  // namespace emmy
