// All files of a report.

#ifndef EMMY_VERIFICATION_REPORT_WRITE_REPORT_H_
#define EMMY_VERIFICATION_REPORT_WRITE_REPORT_H_

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "verification/claim.h"
#include "verification/report/environment.h"

namespace emmy::verification {

// Writes index.html, report.json, junit.xml and the files of each figure to
// `directory`, which exists. Figures are drawn on environment.threads threads.
// Fails if a file cannot be written. Figures that could not be drawn are no
// failure: they are returned as messages, and their data and scripts are there.
absl::StatusOr<std::vector<std::string>> WriteReport(
    const std::vector<Outcome>& outcomes, const Environment& environment,
    const std::string& directory);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_WRITE_REPORT_H_
