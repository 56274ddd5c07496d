// Reads a JSON value field by field and keeps the first error.
//
// A reader knows where its value stands, so that every message begins with
// the JSON pointer: "/integrator/time_step: must be a finite number > 0 [s],
// got -1". After the first error all reads return defaults and change
// nothing; a reading function is therefore a plain list of fields, checked
// once at its end.

#ifndef EMMY_IO_JSON_READER_H_
#define EMMY_IO_JSON_READER_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "emmy/base/types.h"

namespace emmy {

// The keys of one kind of object. Empty names end each list.
struct ObjectKeys {
  absl::string_view kind;  // As in "$defs" of the schema.
  std::array<absl::string_view, 8> required = {};
  std::array<absl::string_view, 12> optional = {};
};

class JsonReader {
 public:
  // `value` and `status` must outlive the reader.
  JsonReader(const nlohmann::json& value, std::string pointer,
             absl::Status* status)
      : value_(&value), pointer_(std::move(pointer)), status_(status) {}

  // Fails unless this is an object with all required keys and no unknown ones.
  void ExpectKeys(const ObjectKeys& keys) const;

  bool Has(absl::string_view key) const;

  // The one key of `keys` that is present. Fails, and returns "", if there is
  // none (only ExactlyOneOf) or more than one.
  absl::string_view ExactlyOneOf(
      std::initializer_list<absl::string_view> keys) const;
  absl::string_view AtMostOneOf(
      std::initializer_list<absl::string_view> keys) const;

  // The member `key`; reads from a missing one fail.
  JsonReader operator[](absl::string_view key) const;

  // Calls `read(element)` for each element; fails unless this is an array.
  template <typename Read>
  void ForEach(absl::string_view expectation, const Read& read) const {
    if (!ExpectArray(expectation)) return;
    for (size_t i = 0; i < value_->size() && ok(); ++i) read(Element(i));
  }

  // `expectation` completes "must be ...", with the unit: "a finite number > 0
  // [s]". Only the type is checked here.
  double Number(absl::string_view expectation) const;
  int64_t Integer(absl::string_view expectation) const;  // 10 and 10.0 are.
  bool Boolean() const;
  std::string String(absl::string_view expectation) const;
  // Three numbers of the given unit.
  Vector3d Vector(absl::string_view unit) const;
  // An array of `size` numbers. `each` is the expectation of one element, for
  // when the length is right: "a finite number [m]".
  void Numbers(absl::string_view expectation, absl::string_view each,
               size_t size, double* out) const;

  bool is_array() const { return value_->is_array(); }
  bool is_object() const { return value_->is_object(); }
  bool is_string() const { return value_->is_string(); }
  size_t size() const { return value_->size(); }
  JsonReader Element(size_t i) const;

  // Records "<pointer>: must be <expectation>, got <value>".
  void Fail(absl::string_view expectation) const;
  // Records "<pointer>: <message>".
  void FailWith(absl::string_view message) const;
  bool ok() const { return status_->ok(); }

 private:
  bool ExpectArray(absl::string_view expectation) const;

  const nlohmann::json* value_;
  std::string pointer_;
  absl::Status* status_;
};

}  // namespace emmy

#endif  // EMMY_IO_JSON_READER_H_
