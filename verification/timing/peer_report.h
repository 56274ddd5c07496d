// The same cases by other engines: what emmy_peer_benchmark measured.

#ifndef EMMY_VERIFICATION_TIMING_PEER_REPORT_H_
#define EMMY_VERIFICATION_TIMING_PEER_REPORT_H_

#include <string>
#include <vector>

#include "verification/timing/timing.h"
#include "verification/timing/timing_report.h"

namespace emmy::verification {

// What the project has set itself against other engines.
const std::vector<Ratio>& PeerRatios();

// Markdown: these ratios, then for each case of benchmarks peers/CASE/WHO a
// table of times, of these over the ANCF body's, of errors, and of settings.
// Benchmarks of other names are left out.
std::string PeerReport(const TimingRun& run);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_PEER_REPORT_H_
