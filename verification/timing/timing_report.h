// The timing report: ratios against their targets, growth, all times.

#ifndef EMMY_VERIFICATION_TIMING_TIMING_REPORT_H_
#define EMMY_VERIFICATION_TIMING_TIMING_REPORT_H_

#include <string>
#include <vector>

#include "verification/timing/timing.h"

namespace emmy::verification {

// A time over another of the same run, or over a published one, and what it
// should be: at most, or at least, the target. `basis` says where that comes
// from: "set" is what the project has set itself, with what to read it by.
struct Ratio {
  std::string sentence;
  std::string numerator;    // Names of benchmarks.
  std::string denominator;  // Divided by.
  double target = 0.0;
  bool at_least = false;  // The ratio should be that large, not that small.
  std::string basis;
  double published = 0.0;  // [ns] In place of an empty denominator.
};

const std::vector<Ratio>& Ratios();

// A Markdown table of them, with what was not measured.
std::string RatioTable(const TimingRun& run, const std::vector<Ratio>& ratios);

// "3.02", or "1.2e-16" for an error; "–" if the benchmark has no such counter.
std::string CounterText(const Timing& timing, const std::string& name,
                        bool is_error);

// p of time = C size^p over benchmarks of several sizes, and what it should be
// at most.
struct Growth {
  std::string sentence;
  std::vector<std::pair<double, std::string>> sizes;  // Size, benchmark.
  double target = 0.0;
  std::string basis;  // As of a Ratio.
};

const std::vector<Growth>& Growths();

// "64 ns", "7.59 us", "43.5 ms", "1.05 s".
std::string TimeText(double nanoseconds);

// Markdown: tables of ratios, growth and times, and the environment.
std::string TimingReport(const TimingRun& run);

// What became slower or faster by more than the spread of both, one a line.
std::string CompareTimings(const TimingRun& before, const TimingRun& now);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_TIMING_REPORT_H_
