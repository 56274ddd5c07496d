#include "tests/support/schema_checker.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>

#include "emmy/base/check.h"

namespace emmy {
namespace {

using Json = nlohmann::json;

bool HasType(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  EMMY_CHECK(type == "integer", type);  // 1.0 is one.
  return value.is_number() &&
         value.get<double>() == std::floor(value.get<double>());
}

// Those of valid UTF-8: a pattern is about characters, not about bytes.
std::wstring Characters(const std::string& text) {
  std::wstring characters;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) {
      const auto begun = static_cast<unsigned>(characters.back());
      characters.back() = static_cast<wchar_t>((begun << 6U) | (byte & 0x3FU));
    } else if (byte < 0x80U) {
      characters += static_cast<wchar_t>(byte);
    } else {  // The ones before the first zero tell how many bytes follow.
      const unsigned bits = byte < 0xE0U ? 0x1FU : byte < 0xF0U ? 0x0FU : 0x07U;
      characters += static_cast<wchar_t>(byte & bits);
    }
  }
  return characters;
}

// A keyword says nothing about values of other types.
bool IsAbout(const std::string& keyword, const Json& value) {
  static const auto& kNumberKeywords = *new std::set<std::string>{
      "minimum", "exclusiveMinimum", "exclusiveMaximum"};
  static const auto& kArrayKeywords =
      *new std::set<std::string>{"items", "minItems", "maxItems"};
  static const auto& kObjectKeywords = *new std::set<std::string>{
      "properties", "required", "additionalProperties"};
  if (kNumberKeywords.count(keyword) > 0) return value.is_number();
  if (kArrayKeywords.count(keyword) > 0) return value.is_array();
  if (kObjectKeywords.count(keyword) > 0) return value.is_object();
  if (keyword == "minLength" || keyword == "pattern") return value.is_string();
  return true;
}

}  // namespace

bool SchemaChecker::Check(const Json& schema, const Json& value) const {
  for (const auto& member : schema.items()) {
    if (IsAbout(member.key(), value) &&
        !CheckKeyword(schema, member.key(), value)) {
      return false;
    }
  }
  return true;
}

size_t SchemaChecker::CountValid(const Json& schemas, const Json& value) const {
  return static_cast<size_t>(
      std::count_if(schemas.begin(), schemas.end(),
                    [&](const Json& schema) { return Check(schema, value); }));
}

bool SchemaChecker::CheckKeyword(const Json& schema, const std::string& keyword,
                                 const Json& value) const {
  const Json& rule = schema[keyword];
  if (keyword == "$schema" || keyword == "title" || keyword == "description" ||
      keyword == "$defs" || keyword == "then" || keyword == "else") {
    return true;  // Not a rule of its own.
  }
  if (keyword == "$ref") {
    const std::string pointer = rule.get<std::string>().substr(1);
    return Check(schema_.at(Json::json_pointer(pointer)), value);
  }
  if (keyword == "type") return HasType(value, rule);
  if (keyword == "const") return value == rule;
  if (keyword == "enum") {
    return std::find(rule.begin(), rule.end(), value) != rule.end();
  }
  if (keyword == "minimum") return value.get<double>() >= rule.get<double>();
  if (keyword == "exclusiveMinimum") {
    return value.get<double>() > rule.get<double>();
  }
  if (keyword == "exclusiveMaximum") {
    return value.get<double>() < rule.get<double>();
  }
  if (keyword == "minLength") {
    return value.get<std::string>().size() >= rule.get<size_t>();
  }
  if (keyword == "pattern") {  // Anywhere in the text.
    return std::regex_search(Characters(value.get<std::string>()),
                             std::wregex(Characters(rule.get<std::string>())));
  }
  if (keyword == "minItems") return value.size() >= rule.get<size_t>();
  if (keyword == "maxItems") return value.size() <= rule.get<size_t>();
  if (keyword == "items") {
    return std::all_of(value.begin(), value.end(),
                       [&](const Json& item) { return Check(rule, item); });
  }
  if (keyword == "required") {
    return std::all_of(rule.begin(), rule.end(), [&](const Json& key) {
      return value.contains(key.get<std::string>());
    });
  }
  if (keyword == "properties") {
    const auto members = value.items();
    return std::all_of(members.begin(), members.end(), [&](const auto& m) {
      return !rule.contains(m.key()) || Check(rule[m.key()], m.value());
    });
  }
  if (keyword == "additionalProperties") {
    EMMY_CHECK(rule == false, rule);
    const auto members = value.items();
    return std::all_of(members.begin(), members.end(), [&](const auto& m) {
      return schema["properties"].contains(m.key());
    });
  }
  if (keyword == "oneOf") return CountValid(rule, value) == 1;
  if (keyword == "anyOf") return CountValid(rule, value) >= 1;
  if (keyword == "not") return !Check(rule, value);
  if (keyword == "if") {
    const char* branch = Check(rule, value) ? "then" : "else";
    return !schema.contains(branch) || Check(schema[branch], value);
  }
  EMMY_CHECK(false, "unknown keyword " << keyword);
  return false;
}

}  // namespace emmy
