// Judges a JSON value by a JSON Schema, for the keywords our schemas use.
//
// A keyword it does not know is an error, so that no rule of the schema is
// passed over in silence.

#ifndef EMMY_TESTS_SUPPORT_SCHEMA_CHECKER_H_
#define EMMY_TESTS_SUPPORT_SCHEMA_CHECKER_H_

#include <nlohmann/json.hpp>

namespace emmy {

class SchemaChecker {
 public:
  // References ("$ref") are looked up in `schema`, which must outlive this.
  explicit SchemaChecker(const nlohmann::json& schema) : schema_(schema) {}

  // Whether `value` is valid. Stops the program at an unknown keyword.
  bool IsValid(const nlohmann::json& value) const {
    return Check(schema_, value);
  }

 private:
  bool Check(const nlohmann::json& schema, const nlohmann::json& value) const;
  bool CheckKeyword(const nlohmann::json& schema, const std::string& keyword,
                    const nlohmann::json& value) const;
  size_t CountValid(const nlohmann::json& schemas,
                    const nlohmann::json& value) const;

  const nlohmann::json& schema_;
};

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_SCHEMA_CHECKER_H_
