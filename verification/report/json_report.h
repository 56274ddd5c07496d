// The outcomes as JSON, format emmy-report/1: report.schema.json.

#ifndef EMMY_VERIFICATION_REPORT_JSON_REPORT_H_
#define EMMY_VERIFICATION_REPORT_JSON_REPORT_H_

#include <string>
#include <vector>

#include "verification/claim.h"
#include "verification/report/environment.h"

namespace emmy::verification {

// Numbers that are not finite, which JSON has not, are strings: "nan", "inf",
// "-inf".
std::string JsonReport(const std::vector<Outcome>& outcomes,
                       const Environment& environment);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_JSON_REPORT_H_
