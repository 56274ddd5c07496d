#include "verification/timing/timing_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "verification/timing/peer_report.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Row(const std::string& name, double time, const std::string& unit,
                double energy_error = 1e-17) {
  return absl::StrFormat(
      R"({"name": "%s", "run_name": "%s", "run_type": "iteration",
          "iterations": 10, "real_time": 0.5, "cpu_time": %g,
          "time_unit": "%s", "newton_iterations": 3, "energy_error": %g})",
      name, name, time, unit, energy_error);
}

// A file of Google Benchmark's with these rows.
std::string FileWith(const std::string& name, const std::string& rows) {
  std::string path = ::testing::TempDir() + name;
  std::ofstream(path) << R"({"context": {"date": "2026-01-02", "num_cpus": 2,
    "mhz_per_cpu": 2600, "caches": [], "library_build_type": "release"},
    "benchmarks": [)" << rows
                      << "]}";
  return path;
}

TimingRun Read(const std::string& path) {
  absl::StatusOr<TimingRun> run = ReadTimings(path);
  EXPECT_TRUE(run.ok()) << run.status();
  return run.ok() ? *run : TimingRun();
}

TEST(TimingTest, TakesTheMedianOfTheRepetitionsInNanoseconds) {
  const TimingRun run = Read(FileWith(
      "median.json", absl::StrCat(Row("a", 3.0, "us"), ",", Row("a", 1.0, "us"),
                                  ",", Row("a", 2.0, "us"))));
  ASSERT_EQ(run.timings.size(), 1U);
  EXPECT_EQ(run.timings[0].median, 2000.0);
  EXPECT_EQ(run.timings[0].spread, 1.0);
  EXPECT_EQ(run.timings[0].repetitions, 3);
  EXPECT_EQ(run.timings[0].counters.at("energy_error"), 1e-17);
}

TEST(TimingTest, IgnoresAggregatesAndSettingsInNames) {
  const TimingRun run = Read(
      FileWith("names.json",
               absl::StrCat(Row("net/side:30/min_time:1.000", 3.0, "ms"), R"(,
        {"name": "net/side:30_mean", "run_name": "net/side:30",
         "run_type": "aggregate", "cpu_time": 9, "time_unit": "ms"})")));
  ASSERT_EQ(run.timings.size(), 1U);
  EXPECT_EQ(run.timings[0].name, "net/side:30");
  EXPECT_EQ(run.timings[0].median, 3e6);
}

TEST(TimingTest, ABenchmarkThatFailedHasNoTime) {
  const TimingRun run =
      Read(FileWith("failed.json",
                    R"({"name": "a", "run_name": "a", "run_type": "iteration",
          "error_occurred": true, "error_message": "energy error 1e-3",
          "cpu_time": 5, "time_unit": "ns"})"));
  EXPECT_EQ(run.Find("a"), nullptr);
  EXPECT_THAT(TimingReport(run), HasSubstr("failed: energy error 1e-3"));
}

TEST(TimingTest, NamesTheFileThatItCannotRead) {
  EXPECT_THAT(ReadTimings("no/such.json").status().message(),
              HasSubstr("no/such.json: cannot open"));
  const std::string path = ::testing::TempDir() + "bad.json";
  std::ofstream(path) << "[1, 2]";
  EXPECT_THAT(ReadTimings(path).status().message(), HasSubstr("bad.json"));
}

TEST(TimingReportTest, SaysWhetherARatioMeetsItsTarget) {
  const auto report = [](double time) {
    return TimingReport(Read(FileWith(
        "ratio.json", absl::StrCat(Row("one_body/runge_kutta", 40.0, "ns"), ",",
                                   Row("one_body/ancf_relaxed", time, "ns")))));
  };
  EXPECT_THAT(report(100.0), HasSubstr("| 2.5 | <= 3 | met |"));
  EXPECT_THAT(report(200.0), HasSubstr("| 5 | <= 3 | **missed** |"));
}

// 904 ms for all boxes.
TEST(TimingReportTest, APublishedTimeIsDividedByWhereThereIsNoOther) {
  const auto report = [](double time) {
    return TimingReport(Read(
        FileWith("published.json", Row("chain/long/threads:1", time, "ms"))));
  };
  EXPECT_THAT(report(850.0), HasSubstr("| 0.94 | <= 1 | met |"));
  EXPECT_THAT(report(950.0), HasSubstr("| 1.05 | <= 1 | **missed** |"));
}

TEST(TimingReportTest, EveryTargetSaysWhereItComesFrom) {
  const std::string text = TimingReport(TimingRun());
  for (const Ratio& ratio : Ratios()) {
    EXPECT_NE(ratio.basis, "") << ratio.sentence;
    EXPECT_THAT(text, HasSubstr(absl::StrFormat("%g | | %s |\n", ratio.target,
                                                ratio.basis)));
  }
  for (const Growth& growth : Growths()) {
    EXPECT_NE(growth.basis, "") << growth.sentence;
    EXPECT_THAT(text, HasSubstr(absl::StrFormat("%g | | %s |\n", growth.target,
                                                growth.basis)));
  }
  for (const Ratio& ratio : PeerRatios()) {
    EXPECT_NE(ratio.basis, "") << ratio.sentence;
  }
}

// Each name begins those of a benchmark with a ratio of its threads.
TEST(TimingReportTest, NamesWhatIsMeasuredByTheClock) {
  const std::string text = TimingReport(TimingRun());
  for (const char* const name : {"batch_clock", "net/large", "chain/long"}) {
    EXPECT_THAT(text, HasSubstr(absl::StrCat("`", name, "`")));
    EXPECT_TRUE(std::any_of(Ratios().begin(), Ratios().end(),
                            [&name](const Ratio& ratio) {
                              return ratio.denominator.rfind(name, 0) == 0;
                            }))
        << name;
  }
}

TEST(TimingReportTest, SaysWhatWasNotMeasured) {
  const TimingRun run =
      Read(FileWith("one.json", Row("one_body/runge_kutta", 40.0, "ns")));
  EXPECT_THAT(TimingReport(run), HasSubstr("| not measured | <= 3 |"));
}

TEST(TimingReportTest, FitsTheGrowth) {
  const TimingRun run = Read(FileWith(
      "growth.json", absl::StrCat(Row("chain/boxes:100", 1.0, "us"), ",",
                                  Row("chain/boxes:1000", 10.0, "us"), ",",
                                  Row("chain/boxes:10000", 100.0, "us"))));
  EXPECT_THAT(TimingReport(run), HasSubstr("| 1.00 | <= 1.1 | met |"));
}

TEST(TimingReportTest, FitsNoGrowthWhereASizeIsMissing) {
  const TimingRun run = Read(FileWith(
      "partial.json", absl::StrCat(Row("chain/boxes:100", 1.0, "us"), ",",
                                   Row("chain/boxes:1000", 10.0, "us"))));
  EXPECT_THAT(TimingReport(run),
              HasSubstr("100 to 10,000, by boxes | not measured |"));
}

TEST(TimeTextTest, HasAUnitThatFitsTheTime) {
  EXPECT_EQ(TimeText(64.0), "64 ns");
  EXPECT_EQ(TimeText(7.59e3), "7.59 us");
  EXPECT_EQ(TimeText(43.5e6), "43.5 ms");
  EXPECT_EQ(TimeText(848e6), "848 ms");
  EXPECT_EQ(TimeText(1.05e9), "1.05 s");
  EXPECT_EQ(TimeText(12.3e9), "12.3 s");
}

TEST(CompareTimingsTest, NamesWhatChangedBeyondItsSpread) {
  const TimingRun before =
      Read(FileWith("before.json", absl::StrCat(Row("a", 10.0, "ns"), ",",
                                                Row("b", 10.0, "ns"))));
  const TimingRun now =
      Read(FileWith("now.json", absl::StrCat(Row("a", 20.0, "ns"), ",",
                                             Row("b", 10.2, "ns"))));
  const std::string text = CompareTimings(before, now);
  EXPECT_THAT(text, HasSubstr("slower: 20 ns, was 10 ns (x 2.00)"));
  EXPECT_THAT(text, Not(HasSubstr("10.2")));
  EXPECT_THAT(CompareTimings(now, now), HasSubstr("No time changed"));
}

}  // namespace
}  // namespace emmy::verification
