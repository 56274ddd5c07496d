// JSON text to values and back, strictly and with bounded effort.
//
// Stricter than the JSON library alone, because a case that is read must be
// the case that was written:
//   * a key that occurs twice in an object is an error (not "the last wins");
//   * a NUL byte is an error (not the end of the text);
//   * a number outside the range of double (1e999) is an error at its place;
//   * nesting is limited to kMaxJsonDepth, size to kMaxJsonBytes.
// Internal to io: the only headers that show nlohmann::json are json_*.h.

#ifndef EMMY_IO_JSON_TEXT_H_
#define EMMY_IO_JSON_TEXT_H_

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace emmy {

inline constexpr size_t kMaxJsonDepth = 32;
// Parsing holds at most about 40 times the size of the text in memory.
inline constexpr size_t kMaxJsonBytes = size_t{256} << 20;

// The value written in `text`, which must be UTF-8. Fails with
// kInvalidArgument: syntax errors give "line L, column C: ...", all others
// begin with the JSON pointer.
absl::StatusOr<nlohmann::json> ParseJson(absl::string_view text);

// `value` as text for people: what fits in 80 columns stands on one line.
// Numbers have as many digits as it takes to read the same double again.
std::string FormatJson(const nlohmann::ordered_json& value);

// `value` as part of a message: on one line, and shortened where it is long.
std::string ShowJson(const nlohmann::json& value);

// Whether `text` is valid UTF-8, as JSON text must be.
bool IsUtf8(absl::string_view text);

// `text` with at most `max_bytes` bytes, cut between UTF-8 characters and then
// ending in "...".
std::string Shorten(std::string text, size_t max_bytes);

// "/" + `key` as a part of a JSON pointer (RFC 6901), shortened for messages.
std::string PointerPart(absl::string_view key);

}  // namespace emmy

#endif  // EMMY_IO_JSON_TEXT_H_
