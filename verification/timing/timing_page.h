// The timing report as one page.

#ifndef EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_
#define EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_

#include <string>
#include <vector>

#include "verification/timing/timing.h"

namespace emmy::verification {

struct TimingFigure {
  std::string name;  // Of its file, without ending.
  std::string heading;
  std::string alternative;  // What it shows, for who does not see it.
  std::string caption;
  std::string svg;
  std::string csv;
};

struct TimingPageParts {
  std::string report;  // Markdown: ratios, growth, times; and comparisons.
  std::string peers;   // Markdown; may be empty.
  std::vector<TimingFigure> figures;
};

// Self-contained, in the style of the verification report: how many targets
// are met, the tables, the figures with their data, where it was measured.
std::string TimingPage(const TimingRun& run, const TimingPageParts& parts);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_TIMING_PAGE_H_
