// Checks of single fields, with messages that name the field's JSON pointer.

#ifndef EMMY_MODEL_VALIDATION_H_
#define EMMY_MODEL_VALIDATION_H_

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "emmy/base/types.h"

namespace emmy {

// `<pointer>: must be <expectation>, got <got>`
absl::Status FieldError(std::string_view pointer, std::string_view expectation,
                        std::string_view got);

// `unit` is shown in brackets; empty: none.
absl::Status CheckPositive(std::string_view pointer, double value,
                           std::string_view unit);
absl::Status CheckNotNegative(std::string_view pointer, double value,
                              std::string_view unit);
absl::Status CheckFinite(std::string_view pointer, const Vector3d& value,
                         std::string_view unit);

// The least mass that is not nothing [kg], and volume [m^3] or second moment
// [kg m^2] of a body: the products of three in a determinant, and the low-order
// parts of these (DoubleDouble), are not lost below the smallest double.
inline constexpr double kLeastMass = 1e-90;

// Zero, or kLeastMass at least.
absl::Status CheckMass(std::string_view pointer, double mass);

// With control characters as \u0007: for messages.
std::string EscapeControls(std::string_view text);

// The same in quotation marks.
std::string NameText(std::string_view name);

// Whether `text`, in UTF-8, has no control characters (below U+0020, and from
// U+007F to U+009F).
bool IsPrintable(std::string_view text);

// Shortest text that reads back as the same number; "nan", "inf".
std::string NumberText(double value);

}  // namespace emmy

#endif  // EMMY_MODEL_VALIDATION_H_
