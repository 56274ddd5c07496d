// What a run of the benchmarks measured, read from Google Benchmark's JSON.

#ifndef EMMY_VERIFICATION_TIMING_TIMING_H_
#define EMMY_VERIFICATION_TIMING_TIMING_H_

#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace emmy::verification {

// One benchmark over its repetitions.
struct Timing {
  std::string name;
  // Processor time of an iteration [ns]; by the clock for benchmarks with
  // threads of their own; of one step of one body for batches.
  double median = 0.0;
  // Largest less smallest over the median: how far to trust a ratio.
  double spread = 0.0;
  int repetitions = 0;
  std::map<std::string, double> counters;  // Medians.
  std::string label;                       // What was set; else "".
  std::string error;                       // Why there is no time; else "".
};

struct TimingRun {
  std::string date;
  std::string processor;  // Number, clock and data caches.
  std::string program;    // Version, compiler and flags of what was timed.
  std::vector<Timing> timings;

  // Null if there is none, or it ended with an error.
  const Timing* Find(const std::string& name) const;
};

// Fails, naming the file and what is wrong, if it is not such a file.
absl::StatusOr<TimingRun> ReadTimings(const std::string& path);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_TIMING_H_
