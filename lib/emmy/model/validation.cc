#include "emmy/model/validation.h"

#include <algorithm>
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

bool IsControl(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

}  // namespace

std::string NumberText(double value) {
  std::array<char, 32> buffer{};
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::string NameText(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (IsControl(c)) {
      text += absl::StrFormat("\\u%04x", static_cast<unsigned>(c));
    } else {
      text += c;
    }
  }
  return text + "\"";
}

bool IsPrintable(std::string_view text) {
  return std::none_of(text.begin(), text.end(), IsControl);
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
