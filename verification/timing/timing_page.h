// The timing report as one page.

#ifndef EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_
#define EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_

#include <string>

#include "verification/timing/timing.h"

namespace emmy::verification {

struct TimingPageParts {
  std::string report;  // Markdown: ratios, growth, times; and comparisons.
  std::string peers;   // Markdown; may be empty.
  std::string svg;     // Work-precision figure and its data; may be empty.
  std::string csv;
};

// Self-contained, in the style of the verification report: how many targets
// are met, the tables, the figure with its data, where it was measured.
std::string TimingPage(const TimingRun& run, const TimingPageParts& parts);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_
