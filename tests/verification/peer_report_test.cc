#include "verification/timing/peer_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

Timing Measured(const std::string& name, double median) {
  Timing timing;
  timing.name = name;
  timing.median = median;
  timing.counters = {{"energy_error", 7e-4}};
  timing.label = "as it is set";
  return timing;
}

TEST(PeerReportTest, DividesByTheAncfBodyAndShowsSettings) {
  TimingRun run;
  run.timings = {Measured("peers/box/emmy_ancf", 100.0),
                 Measured("peers/box/ode", 250.0)};
  EXPECT_THAT(PeerReport(run), HasSubstr("| `ode` | 250 ns | 0 % | 2.5 | "
                                         "7.0e-04 | – | as it is set |"));
}

TEST(PeerReportTest, SaysWhetherATargetIsMet) {
  TimingRun run;
  run.timings = {Measured("peers/chain:1000/emmy_ancf", 100.0),
                 Measured("peers/chain:1000/bullet", 100.0)};
  const std::string report = PeerReport(run);
  EXPECT_THAT(report, HasSubstr("| 1 | <= 0.6 | **missed** |"));
  EXPECT_THAT(report, HasSubstr("| not measured | >= 12 |"));
}

TEST(PeerReportTest, AFailedEngineHasNoTime) {
  TimingRun run;
  run.timings = {Measured("peers/box/ode", 250.0)};
  run.timings[0].error = "blew up";
  EXPECT_THAT(PeerReport(run), HasSubstr("| `ode` | failed: blew up |"));
}

}  // namespace
}  // namespace emmy::verification
