#include "emmy/io/json_override.h"

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "emmy/io/json_text.h"

namespace emmy {
namespace {

using Json = nlohmann::json;

// The parts of a JSON pointer, unescaped.
std::vector<std::string> Parts(const Json::json_pointer& pointer) {
  std::vector<std::string> parts =
      absl::StrSplit(pointer.to_string(), '/');  // The first is empty.
  parts.erase(parts.begin());
  for (std::string& part : parts) {
    part = absl::StrReplaceAll(part, {{"~1", "/"}, {"~0", "~"}});
  }
  return parts;
}

bool IsIndex(absl::string_view part, size_t* index) {
  const bool canonical = part == "0" || (!part.empty() && part[0] != '0');
  return canonical &&
         part.find_first_not_of("0123456789") == absl::string_view::npos &&
         absl::SimpleAtoi(part, index);
}

// A pointer whose every "~" begins "~0" or "~1".
bool IsPointer(absl::string_view text) {
  if (text.size() < 2 || text[0] != '/') return false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '~') continue;
    if (i + 1 == text.size() || (text[i + 1] != '0' && text[i + 1] != '1')) {
      return false;
    }
  }
  return true;
}

}  // namespace

absl::StatusOr<JsonOverride> ParseOverride(absl::string_view setting) {
  const size_t equals = setting.find('=');
  if (equals == absl::string_view::npos ||
      !IsPointer(setting.substr(0, equals))) {
    return absl::InvalidArgumentError(
        absl::StrCat("must have the form /json/pointer=value, got ",
                     ShowJson(std::string(setting))));
  }
  if (!IsUtf8(setting)) {
    return absl::InvalidArgumentError(
        absl::StrCat("must be UTF-8, got ", ShowJson(std::string(setting))));
  }
  const absl::string_view text = setting.substr(equals + 1);
  absl::StatusOr<Json> value = ParseJson(text);
  return JsonOverride{
      Json::json_pointer(std::string(setting.substr(0, equals))),
      value.ok() ? *std::move(value) : Json(std::string(text))};
}

absl::Status ApplyOverride(const JsonOverride& change, Json* root) {
  Json* place = root;
  std::string pointer;
  for (const std::string& part : Parts(change.pointer)) {
    const std::string parent = pointer;
    absl::StrAppend(&pointer, PointerPart(part));
    if (place->is_array()) {
      size_t index = 0;
      if (!IsIndex(part, &index) || index >= place->size()) {
        return absl::InvalidArgumentError(
            absl::StrCat(pointer, ": no such element, ", parent, " has ",
                         place->size(), " (counted from 0)"));
      }
      place = &(*place)[index];
    } else if (place->is_object() || place->is_null()) {
      place = &(*place)[part];  // Null becomes an object.
    } else {
      return absl::InvalidArgumentError(absl::StrCat(
          pointer, ": no such place, ", parent, " is ", ShowJson(*place)));
    }
  }
  *place = change.value;
  return absl::OkStatus();
}

}  // namespace emmy
