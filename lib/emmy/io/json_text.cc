#include "emmy/io/json_text.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxShown = 60;   // Bytes of a value or key in a message.
constexpr size_t kLineWidth = 80;  // Of formatted text.

bool IsUtf8Continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// On one line and without control characters, whatever is in it.
std::string Printable(const Json& value) {
  return EscapeControls(  // JSON leaves those from U+007F on as they are.
      value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// "line L, column C" of the byte number `position` (the first is 1), counting
// characters in a line.
std::string LineAndColumn(absl::string_view text, size_t position) {
  const absl::string_view before =
      text.substr(0, position > 0 ? position - 1 : 0);
  const size_t last_newline = before.rfind('\n');
  const absl::string_view line = last_newline == absl::string_view::npos
                                     ? before
                                     : before.substr(last_newline + 1);
  return absl::StrCat(
      "line ", 1 + std::count(before.begin(), before.end(), '\n'), ", column ",
      1 + std::count_if(line.begin(), line.end(),
                        [](char c) { return !IsUtf8Continuation(c); }));
}

// The library's explanation without its prefix, made printable.
std::string Explanation(std::string what) {
  const size_t start = what.find("syntax error");
  if (start != std::string::npos) what.erase(0, start);
  const size_t last_read = what.find("; last read:");
  if (last_read != std::string::npos) what.erase(last_read);
  for (char& c : what) {
    if (c < ' ' || c > '~') c = '?';
  }
  return Shorten(std::move(what), 160);
}

// Receives the parser's events and builds the value.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  explicit DocumentBuilder(absl::string_view text) : text_(text) {}

  absl::Status status() const { return status_; }
  Json TakeRoot() { return std::move(root_); }

  bool null() override { return Add(nullptr) != nullptr; }
  bool boolean(bool value) override { return Add(value) != nullptr; }
  bool number_integer(number_integer_t value) override {
    return Add(value) != nullptr;
  }
  bool number_unsigned(number_unsigned_t value) override {
    return Add(value) != nullptr;
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return Add(value) != nullptr;
  }
  bool string(string_t& value) override {
    return Add(std::move(value)) != nullptr;
  }
  bool binary(binary_t& /*value*/) override { return false; }  // Not in JSON.

  bool start_object(size_t /*size*/) override { return Open(Json::object()); }
  bool start_array(size_t /*size*/) override { return Open(Json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& key) override {
    Container& top = open_.back();
    top.key = std::move(key);
    if (top.value->contains(top.key)) {
      return Fail(absl::StrCat(Pointer(), ": duplicate key"));
    }
    return true;
  }

  bool parse_error(size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override {
    constexpr int kNumberOutOfRange = 406;
    if (error.id == kNumberOutOfRange) {
      return FailAtPointer("must be a finite number, got ",
                           Shorten(last_token, kMaxShown));
    }
    return Fail(absl::StrCat(LineAndColumn(text_, position),
                             ": not valid JSON: ", Explanation(error.what())));
  }

 private:
  struct Container {
    Json* value;
    std::string key;  // Of the member being read, if an object.
  };

  // Puts a value in its place; null after an error.
  Json* Add(Json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Container& top = open_.back();
    if (top.value->is_object()) {
      return &((*top.value)[top.key] = std::move(value));
    }
    top.value->push_back(std::move(value));
    return &top.value->back();
  }

  bool Open(Json container) {
    if (open_.size() >= kMaxJsonDepth) {
      return FailAtPointer("nested deeper than ",
                           absl::StrCat(kMaxJsonDepth, " levels"));
    }
    open_.push_back({Add(std::move(container)), ""});
    return true;
  }

  bool Close() {
    open_.pop_back();
    return true;
  }

  // Where the value being read stands.
  std::string Pointer() const {
    std::string pointer;
    for (const Container& container : open_) {
      const bool innermost = &container == &open_.back();
      if (container.value->is_object()) {
        absl::StrAppend(&pointer, PointerPart(container.key));
      } else {  // An open container is its parent's last element already.
        absl::StrAppend(&pointer, "/",
                        container.value->size() - (innermost ? 0 : 1));
      }
    }
    return pointer;
  }

  bool FailAtPointer(absl::string_view what, absl::string_view detail) {
    const std::string pointer = Pointer();
    return Fail(
        absl::StrCat(pointer, pointer.empty() ? "" : ": ", what, detail));
  }

  bool Fail(absl::string_view message) {
    status_ = absl::InvalidArgumentError(message);
    return false;
  }

  absl::string_view text_;
  Json root_;
  std::vector<Container> open_;
  absl::Status status_;
};

// Appends `value` as it stands on the column `column`.
void Format(const nlohmann::ordered_json& value, size_t indent, size_t column,
            std::string* out) {
  const std::string flat = value.dump();
  const size_t flat_width =  // Blanks after "," and ":" are added.
      flat.size() +
      static_cast<size_t>(std::count(flat.begin(), flat.end(), ',')) +
      static_cast<size_t>(std::count(flat.begin(), flat.end(), ':'));
  const bool is_container = value.is_structured() && !value.empty();
  if (!is_container) {
    absl::StrAppend(out, flat);
    return;
  }
  const bool one_line = column + flat_width + 1 <= kLineWidth;
  const std::string line_break =
      one_line ? "" : absl::StrCat("\n", std::string(indent + 2, ' '));
  absl::StrAppend(out, value.is_object() ? "{" : "[");
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) absl::StrAppend(out, one_line ? ", " : ",");
    first = false;
    absl::StrAppend(out, line_break);
    if (value.is_object()) {
      absl::StrAppend(out, nlohmann::ordered_json(item.key()).dump(), ": ");
    }
    const size_t newline = out->rfind('\n');
    Format(item.value(), indent + 2, one_line ? 0 : out->size() - newline - 1,
           out);
  }
  if (!one_line) absl::StrAppend(out, "\n", std::string(indent, ' '));
  absl::StrAppend(out, value.is_object() ? "}" : "]");
}

}  // namespace

absl::StatusOr<Json> ParseJson(absl::string_view text) {
  if (text.size() > kMaxJsonBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("larger than ", kMaxJsonBytes >> 20, " MiB"));
  }
  if (text.find_first_not_of(" \t\r\n") == absl::string_view::npos) {
    return absl::InvalidArgumentError("empty, must be a JSON object");
  }
  // The library takes it for the end, and would ignore what follows.
  const size_t nul = text.find('\0');
  if (nul != absl::string_view::npos) {
    return absl::InvalidArgumentError(absl::StrCat(
        LineAndColumn(text, nul + 1), ": not valid JSON: a NUL byte"));
  }
  DocumentBuilder builder(text);
  if (!Json::sax_parse(text.begin(), text.end(), &builder)) {
    return builder.status();
  }
  return builder.TakeRoot();
}

std::string FormatJson(const nlohmann::ordered_json& value) {
  std::string text;
  Format(value, 0, 0, &text);
  return text;
}

std::string ShowJson(const Json& value) {
  const bool is_short = value.size() <= 9 &&
                        std::none_of(value.begin(), value.end(),
                                     [](auto& v) { return v.is_structured(); });
  if (value.is_object()) {
    return is_short && value.empty() ? "{}" : "an object";
  }
  if (value.is_array() && !is_short) {
    return absl::StrCat("an array of ", value.size());
  }
  return Shorten(Printable(value), kMaxShown);
}

bool IsUtf8(absl::string_view text) {
  std::string quoted = absl::StrCat("\"", text, "\"");
  for (char& c : quoted) {  // What JSON has rules of its own about.
    if (static_cast<unsigned char>(c) < 0x80U) c = 'a';
  }
  quoted.front() = quoted.back() = '"';
  return Json::accept(quoted);
}

std::string Shorten(std::string text, size_t max_bytes) {
  if (text.size() <= max_bytes) return text;
  size_t end = max_bytes - 3;
  while (end > 0 && IsUtf8Continuation(text[end])) --end;
  text.resize(end);
  return text + "...";
}

std::string PointerPart(absl::string_view key) {
  const std::string escaped =
      absl::StrReplaceAll(key, {{"~", "~0"}, {"/", "~1"}});
  // As a JSON string without its quotation marks: control characters escaped.
  const std::string printable = Printable(escaped);
  return absl::StrCat(
      "/", Shorten(printable.substr(1, printable.size() - 2), kMaxShown));
}

}  // namespace emmy
