// The claims as a table, and its place in verification/README.md.

#ifndef EMMY_VERIFICATION_REPORT_CLAIM_TABLE_H_
#define EMMY_VERIFICATION_REPORT_CLAIM_TABLE_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "verification/claim.h"

namespace emmy::verification {

// For a terminal: id and sentence of each claim.
std::string ClaimList(const std::vector<const Claim*>& claims);

// Everything a claim says, as a Markdown table.
std::string ClaimTable(const std::vector<const Claim*>& claims);

// `document` with the table between its lines `<!-- claims: begin ... -->` and
// `<!-- claims: end -->` replaced. Fails if there are no such lines.
absl::StatusOr<std::string> ReplaceClaimTable(const std::string& document,
                                              const std::vector<Claim>& claims);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_CLAIM_TABLE_H_
