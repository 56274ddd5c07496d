// Files of the project that are computed: what `emmy regenerate` writes.

#ifndef EMMY_VERIFICATION_REFERENCE_ARTIFACT_H_
#define EMMY_VERIFICATION_REFERENCE_ARTIFACT_H_

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace emmy::verification {

struct Artifact {
  std::string name;
  std::string path;         // Below the project's root.
  std::string description;  // What it is, in a few words.
  // How what is computed now differs from what is stored below `root`, in
  // lines; empty if the data are the same. A file that is missing differs.
  std::function<absl::StatusOr<std::string>(const std::string& root)> compare;
  // Computes and writes.
  std::function<absl::Status(const std::string& root)> write;
};

// Regression data, the manifest of all stored data, the table of claims in
// verification/README.md, and the figures of the documents.
const std::vector<Artifact>& AllArtifacts();

// Null if there is none.
const Artifact* FindArtifact(std::string_view name);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_ARTIFACT_H_
