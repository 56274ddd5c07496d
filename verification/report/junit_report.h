// The outcomes as JUnit XML, which CI systems show.

#ifndef EMMY_VERIFICATION_REPORT_JUNIT_REPORT_H_
#define EMMY_VERIFICATION_REPORT_JUNIT_REPORT_H_

#include <string>
#include <vector>

#include "verification/claim.h"
#include "verification/report/environment.h"

namespace emmy::verification {

// A <testsuite> for each group, a <testcase> for each claim with what
// `emmy verify` prints of it. A claim that misses its bound has a <failure>,
// one that could not be measured an <error>; both say value, bound, and the
// command that repeats it.
std::string JunitReport(const std::vector<Outcome>& outcomes,
                        const Environment& environment);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_JUNIT_REPORT_H_
