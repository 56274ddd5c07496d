// What `emmy verify` prints.

#ifndef EMMY_VERIFICATION_REPORT_TEXT_REPORT_H_
#define EMMY_VERIFICATION_REPORT_TEXT_REPORT_H_

#include <string>
#include <vector>

#include "verification/claim.h"

namespace emmy::verification {

// One line: id, verdict, worst value, bound, margin; then its notes.
std::string OutcomeText(const Outcome& outcome);

// The failures, each with value, bound and the command that repeats it, and
// the number of claims that hold.
std::string VerdictText(const std::vector<Outcome>& outcomes);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_TEXT_REPORT_H_
