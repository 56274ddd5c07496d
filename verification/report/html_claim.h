// One claim's part of the page.

#ifndef EMMY_VERIFICATION_REPORT_HTML_CLAIM_H_
#define EMMY_VERIFICATION_REPORT_HTML_CLAIM_H_

#include <map>
#include <string>

#include "verification/claim.h"

namespace emmy::verification {

// SVG of each figure that was drawn, by its name.
using FigureImages = std::map<std::string, std::string>;

// The element id of a claim's section: "claim-<group>-<name>".
std::string ClaimAnchor(const Claim& claim);

// "emmy verify --only <id> --level <level>".
std::string RerunCommand(const Outcome& outcome);

// A row of the table of all claims.
std::string ClaimRow(const Outcome& outcome);

// All that is known of it: values, bound and why, notes, figures with their
// data and scripts, command. A figure without image is replaced by a note.
std::string ClaimArticle(const Outcome& outcome, const FigureImages& images);

// For the list at the top: what failed, by how much, how to see it again, and
// what to look at.
std::string FailureArticle(const Outcome& outcome);

// "12.3 s", "4.5 ms".
std::string DurationText(double seconds);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_HTML_CLAIM_H_
