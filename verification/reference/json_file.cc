#include "verification/reference/json_file.h"

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/json_text.h"
#include "emmy/io/text_file.h"

namespace emmy::verification {

absl::StatusOr<nlohmann::json> ReadJsonFile(const std::string& path) {
  const absl::StatusOr<std::string> text = ReadTextFile(path, kMaxJsonBytes);
  if (!text.ok()) {
    return absl::NotFoundError(
        absl::StrCat(path, ": ", text.status().message()));
  }
  absl::StatusOr<nlohmann::json> json = ParseJson(*text);
  if (!json.ok()) {
    return absl::DataLossError(
        absl::StrCat(path, ": ", json.status().message()));
  }
  return json;
}

}  // namespace emmy::verification
