#include "emmy/io/case_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "emmy/io/case_reader.h"
#include "emmy/io/finite_start.h"
#include "emmy/io/json_override.h"
#include "emmy/io/json_text.h"
#include "emmy/io/text_file.h"

namespace emmy {
namespace {

absl::Status WithPrefix(absl::string_view prefix, const absl::Status& status) {
  return absl::Status(status.code(),
                      absl::StrCat(prefix, ": ", status.message()));
}

// Whether the message is about a place that `setting` changed: it is that
// place or inside it.
bool IsAbout(absl::string_view message, absl::string_view setting) {
  const absl::string_view place = message.substr(0, message.find(':'));
  const absl::string_view changed = setting.substr(0, setting.find('='));
  return absl::StartsWith(absl::StrCat(place, "/"), absl::StrCat(changed, "/"));
}

}  // namespace

absl::Status CaseFileError(const std::string& path,
                           const std::vector<std::string>& overrides,
                           const absl::Status& status) {
  const bool is_override = std::any_of(
      overrides.begin(), overrides.end(), [&](const std::string& setting) {
        return IsAbout(status.message(), setting);
      });
  return absl::Status(status.code(),
                      absl::StrCat(path, ": ", status.message(),
                                   is_override ? " (from --set)" : ""));
}

absl::StatusOr<Case> ParseCase(absl::string_view text,
                               const std::vector<std::string>& overrides) {
  absl::StatusOr<nlohmann::json> json = ParseJson(text);
  if (!json.ok()) return json.status();
  for (const std::string& setting : overrides) {
    const absl::StatusOr<JsonOverride> change = ParseOverride(setting);
    if (!change.ok()) return WithPrefix("--set", change.status());
    const absl::Status applied = ApplyOverride(*change, &*json);
    if (!applied.ok()) return WithPrefix("--set", applied);
  }
  return CaseFromJson(*json);
}

absl::StatusOr<Case> ReadCaseFile(const std::string& path,
                                  const std::vector<std::string>& overrides) {
  const absl::StatusOr<std::string> text = ReadTextFile(path, kMaxJsonBytes);
  if (!text.ok()) return WithPrefix(path, text.status());
  absl::StatusOr<Case> result = ParseCase(*text, overrides);
  if (!result.ok()) return CaseFileError(path, overrides, result.status());
  return result;
}

absl::StatusOr<LoadedCase> BuildCase(Case description) {
  absl::StatusOr<BuiltModel> built = BuildModel(description.model);
  if (!built.ok()) return built.status();
  const absl::Status finite =
      CheckFiniteStart(description.model, built->model, built->state);
  if (!finite.ok()) return finite;
  return LoadedCase{std::move(description), std::move(built->model),
                    std::move(built->state)};
}

absl::StatusOr<LoadedCase> LoadCaseFile(
    const std::string& path, const std::vector<std::string>& overrides) {
  absl::StatusOr<Case> description = ReadCaseFile(path, overrides);
  if (!description.ok()) return description.status();
  absl::StatusOr<LoadedCase> loaded = BuildCase(*std::move(description));
  if (!loaded.ok()) return CaseFileError(path, overrides, loaded.status());
  return loaded;
}

}  // namespace emmy
