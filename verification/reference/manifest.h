// reference_data/manifest.json: what the stored data are and where they are
// from, with a hash of each file.

#ifndef EMMY_VERIFICATION_REFERENCE_MANIFEST_H_
#define EMMY_VERIFICATION_REFERENCE_MANIFEST_H_

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace emmy::verification {

// The hash by which git names a file of these bytes: SHA-1 of "blob <length>",
// a zero byte and the bytes; `git hash-object FILE` prints it.
std::string GitBlobHash(std::string_view bytes);

// The manifest of all JSON files below `root`/reference_data but itself, in
// alphabetical order: path, kind, source, command and hash. Fails, naming the
// file, if one cannot be read or does not say its kind, source and command.
absl::StatusOr<std::string> MakeManifest(const std::string& root);

// How two manifests differ, one line a file; "" if they do not.
std::string DescribeManifestDifference(const std::string& stored,
                                       const std::string& now);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_MANIFEST_H_
