#include "emmy/model/validation.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace emmy {
namespace {

std::string WithUnit(std::string_view expectation, std::string_view unit) {
  std::string text(expectation);
  if (!unit.empty()) {
    text += " [";
    text += unit;
    text += "]";
  }
  return text;
}

// Bytes of the control character that the UTF-8 `text` begins with; 0: none.
size_t ControlBytes(std::string_view text) {
  const auto byte = [text](size_t i) {
    return static_cast<unsigned char>(text[i]);
  };
  if (text.empty()) return 0;
  if (byte(0) < 0x20 || byte(0) == 0x7F) return 1;
  const bool is_later =
      text.size() > 1 && byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0;
  return is_later ? 2 : 0;
}

}  // namespace

std::string NumberText(double value) {
  std::array<char, 32> buffer{};
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::string EscapeControls(std::string_view text) {
  std::string escaped;
  for (size_t i = 0; i < text.size(); ++i) {
    const size_t bytes = ControlBytes(text.substr(i));
    if (bytes == 0) {
      escaped += text[i];
      continue;
    }
    i += bytes - 1;  // The last byte is the character's number in UTF-8, too.
    escaped += absl::StrFormat("\\u%04x", static_cast<unsigned char>(text[i]));
  }
  return escaped;
}

std::string NameText(std::string_view name) {
  return absl::StrCat("\"", EscapeControls(name), "\"");
}

bool IsPrintable(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (ControlBytes(text.substr(i)) > 0) return false;
  }
  return true;
}

absl::Status FieldError(std::string_view pointer, std::string_view expectation,
                        std::string_view got) {
  return absl::InvalidArgumentError(
      absl::StrCat(std::string(pointer), ": must be ", std::string(expectation),
                   ", got ", std::string(got)));
}

absl::Status CheckPositive(std::string_view pointer, double value,
                           std::string_view unit) {
  if (std::isfinite(value) && value > 0.0) return absl::OkStatus();
  return FieldError(pointer, WithUnit("a finite number > 0", unit),
                    NumberText(value));
}

absl::Status CheckNotNegative(std::string_view pointer, double value,
                              std::string_view unit) {
  if (std::isfinite(value) && value >= 0.0) return absl::OkStatus();
  return FieldError(pointer, WithUnit("a finite number >= 0", unit),
                    NumberText(value));
}

absl::Status CheckMass(std::string_view pointer, double mass) {
  if (std::isfinite(mass) && (mass == 0.0 || mass >= kLeastMass)) {
    return absl::OkStatus();
  }
  return FieldError(pointer,
                    absl::StrCat("a mass of 0 or a finite number >= ",
                                 NumberText(kLeastMass), " [kg]"),
                    NumberText(mass));
}

absl::Status CheckFinite(std::string_view pointer, const Vector3d& value,
                         std::string_view unit) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(value(i))) {
      return FieldError(absl::StrCat(std::string(pointer), "/", i),
                        WithUnit("a finite number", unit),
                        NumberText(value(i)));
    }
  }
  return absl::OkStatus();
}

}  // namespace emmy
