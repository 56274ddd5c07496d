#include "verification/report/claim_table.h"

#include <algorithm>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace emmy::verification {
namespace {

constexpr char kBegin[] = "<!-- claims: begin";
constexpr char kEnd[] = "<!-- claims: end -->";

// A vertical bar would end the cell.
std::string Cell(const std::string& text) {
  return absl::StrReplaceAll(text, {{"|", "\\|"}});
}

}  // namespace

std::string ClaimList(const std::vector<const Claim*>& claims) {
  size_t width = 0;
  for (const Claim* claim : claims) width = std::max(width, claim->id.size());
  std::string text;
  for (const Claim* claim : claims) {
    absl::StrAppendFormat(&text, "%-*s  %s\n", static_cast<int>(width),
                          claim->id, claim->sentence);
  }
  return text;
}

std::string ClaimTable(const std::vector<const Claim*>& claims) {
  std::string text =
      "| id | claim | equations, source | reference | metric | bound | where "
      "the bound comes from |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Claim* claim : claims) {
    const std::string unit =
        claim->unit == "-" ? "" : absl::StrCat(" [", claim->unit, "]");
    absl::StrAppend(&text, "| `", claim->id, "` | ", Cell(claim->sentence),
                    " | ", Cell(claim->equations), " | ",
                    ReferenceName(claim->reference), " | ", Cell(claim->metric),
                    unit, " | ", BoundText(claim->bound), " | ",
                    Cell(claim->bound.derivation), " |\n");
  }
  return text;
}

absl::StatusOr<std::string> ReplaceClaimTable(
    const std::string& document, const std::vector<Claim>& claims) {
  const size_t begin = document.find(kBegin);
  const size_t end = document.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    return absl::NotFoundError(absl::StrCat(
        "the lines \"", kBegin, " ... -->\" and \"", kEnd, "\" are missing"));
  }
  const size_t table = document.find('\n', begin) + 1;
  std::vector<const Claim*> all;
  for (const Claim& claim : claims) all.push_back(&claim);
  return absl::StrCat(document.substr(0, table), ClaimTable(all),
                      document.substr(end));
}

}  // namespace emmy::verification
