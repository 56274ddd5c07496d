// Reference data: a table of numbers with where they come from.
//
// Format emmy-reference/1, JSON. `kind` says what the numbers are worth as
// evidence: "analytic" and "published" are, "regression" only shows that
// something changed.

#ifndef EMMY_VERIFICATION_REFERENCE_REFERENCE_TABLE_H_
#define EMMY_VERIFICATION_REFERENCE_REFERENCE_TABLE_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace emmy::verification {

struct ReferenceColumn {
  std::string name;
  std::string unit;          // "-" if it has none.
  double uncertainty = 0.0;  // Largest error of a number, in that unit.
};

struct ReferenceTable {
  std::string name;
  std::string kind;
  std::string source;    // What was computed, or who published it.
  std::string command;   // Makes this file.
  std::string version;   // Of Emmy, when it was made.
  std::string compiler;  // Likewise.
  std::vector<ReferenceColumn> columns;
  std::vector<std::vector<double>> rows;
};

// Numbers have the digits that determine them: reading gives the same bits.
std::string FormatReference(const ReferenceTable& table);

// Messages begin with `path`.
absl::StatusOr<ReferenceTable> ReadReference(const std::string& path);

// How the numbers of `computed` differ from those of `stored`, bit for bit:
// how many, and the worst of each column, in its unit. Empty if they do not.
// Provenance (source, command, version, compiler) is not compared.
std::string DescribeDifference(const ReferenceTable& stored,
                               const ReferenceTable& computed);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_REFERENCE_TABLE_H_
