#include "emmy/io/json_reader.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/string_view.h"
#include "emmy/io/json_text.h"

namespace emmy {
namespace {

// Levenshtein distance; `b` is a known key, hence short.
size_t EditDistance(absl::string_view a, absl::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// The key that was probably meant by `key`, or "".
absl::string_view NearestKey(absl::string_view key,
                             const std::vector<absl::string_view>& known) {
  constexpr size_t kMaxDistance = 2;
  absl::string_view nearest;
  size_t best = kMaxDistance + 1;
  for (const absl::string_view candidate : known) {
    if (key.size() > candidate.size() + kMaxDistance) continue;
    const size_t distance = EditDistance(key, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

template <size_t n>
void AppendKeys(const std::array<absl::string_view, n>& keys,
                std::vector<absl::string_view>* out) {
  for (const absl::string_view key : keys) {
    if (!key.empty()) out->push_back(key);
  }
}

std::string Quoted(absl::string_view key) {
  return absl::StrCat("\"", key, "\"");
}

std::string QuotedList(const std::vector<absl::string_view>& keys,
                       absl::string_view separator) {
  return absl::StrJoin(keys, separator,
                       [](std::string* out, absl::string_view key) {
                         absl::StrAppend(out, Quoted(key));
                       });
}

}  // namespace

void JsonReader::ExpectKeys(const ObjectKeys& keys) const {
  if (!ok()) return;
  if (!value_->is_object()) return Fail("an object");
  std::vector<absl::string_view> known;
  AppendKeys(keys.required, &known);
  const size_t num_required = known.size();
  AppendKeys(keys.optional, &known);

  // Unknown before missing: of a misspelt key this names the place.
  for (const auto& member : value_->items()) {
    const std::string& key = member.key();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const absl::string_view nearest = NearestKey(key, known);
    return (*this)[key].FailWith(absl::StrCat(
        "unknown key, expected one of: ", absl::StrJoin(known, ", "),
        nearest.empty() ? "" : absl::StrCat(" (did you mean ", nearest, "?)")));
  }
  for (size_t i = 0; i < num_required; ++i) {
    if (!Has(known[i])) {
      return (*this)[known[i]].FailWith("required key is missing");
    }
  }
}

bool JsonReader::Has(absl::string_view key) const {
  return value_->is_object() && value_->contains(absl::StrCat(key));
}

absl::string_view JsonReader::ExactlyOneOf(
    std::initializer_list<absl::string_view> keys) const {
  if (!ok()) return "";
  if (std::none_of(keys.begin(), keys.end(),
                   [this](absl::string_view key) { return Has(key); })) {
    FailWith(absl::StrCat("must have one of the keys ", QuotedList(keys, ", "),
                          ", got none of them"));
    return "";
  }
  return AtMostOneOf(keys);
}

absl::string_view JsonReader::AtMostOneOf(
    std::initializer_list<absl::string_view> keys) const {
  if (!ok()) return "";
  std::vector<absl::string_view> present;
  for (const absl::string_view key : keys) {
    if (Has(key)) present.push_back(key);
  }
  if (present.size() > 1) {
    FailWith(absl::StrCat("must have only one of the keys ",
                          QuotedList(keys, ", "), ", got ",
                          QuotedList(present, " and ")));
    return "";
  }
  return present.empty() ? "" : present[0];
}

JsonReader JsonReader::operator[](absl::string_view key) const {
  static const nlohmann::json kMissing;
  return JsonReader(Has(key) ? *value_->find(absl::StrCat(key)) : kMissing,
                    absl::StrCat(pointer_, PointerPart(key)), status_);
}

JsonReader JsonReader::Element(size_t i) const {
  return JsonReader((*value_)[i], absl::StrCat(pointer_, "/", i), status_);
}

double JsonReader::Number(absl::string_view expectation) const {
  if (!ok()) return 0.0;
  if (!value_->is_number()) {
    Fail(expectation);
    return 0.0;
  }
  return value_->get<double>();
}

int64_t JsonReader::Integer(absl::string_view expectation) const {
  if (!ok()) return 0;
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const double number = Number(expectation);
  if (number != std::floor(number) || std::abs(number) > kExact) {
    Fail(expectation);
    return 0;
  }
  return static_cast<int64_t>(number);
}

bool JsonReader::Boolean() const {
  if (!ok()) return false;
  if (!value_->is_boolean()) {
    Fail("true or false");
    return false;
  }
  return value_->get<bool>();
}

std::string JsonReader::String(absl::string_view expectation) const {
  if (!ok()) return "";
  if (!value_->is_string()) {
    Fail(expectation);
    return "";
  }
  return value_->get<std::string>();
}

Vector3d JsonReader::Vector(absl::string_view unit) const {
  Vector3d vector = Vector3d::Zero();
  Numbers(absl::StrCat("three finite numbers [", unit, "]"),
          absl::StrCat("a finite number [", unit, "]"), 3, vector.data());
  return vector;
}

void JsonReader::Numbers(absl::string_view expectation, absl::string_view each,
                         size_t size, double* out) const {
  if (!ok()) return;
  if (!value_->is_array() || value_->size() != size) return Fail(expectation);
  for (size_t i = 0; i < size; ++i) out[i] = Element(i).Number(each);
}

bool JsonReader::ExpectArray(absl::string_view expectation) const {
  if (!ok()) return false;
  if (!value_->is_array()) Fail(expectation);
  return ok();
}

void JsonReader::Fail(absl::string_view expectation) const {
  FailWith(absl::StrCat("must be ", expectation, ", got ", ShowJson(*value_)));
}

void JsonReader::FailWith(absl::string_view message) const {
  if (!ok()) return;
  *status_ = absl::InvalidArgumentError(
      absl::StrCat(pointer_, pointer_.empty() ? "" : ": ", message));
}

}  // namespace emmy
