// The report as one page, index.html.

#ifndef EMMY_VERIFICATION_REPORT_HTML_PAGE_H_
#define EMMY_VERIFICATION_REPORT_HTML_PAGE_H_

#include <string>
#include <vector>

#include "verification/claim.h"
#include "verification/report/environment.h"
#include "verification/report/html_claim.h"

namespace emmy::verification {

// Self-contained: style, script, figures and their data are inside, and its
// content security policy forbids everything from outside. Verdict, failures,
// a table of all claims with filters, then each group with its equations and
// claims, then where and how it was made. Readable without its script.
std::string HtmlPage(const std::vector<Outcome>& outcomes,
                     const Environment& environment,
                     const FigureImages& images);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_HTML_PAGE_H_
