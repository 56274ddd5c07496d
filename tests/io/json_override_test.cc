#include "emmy/io/json_override.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"

namespace emmy {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// The document after the change, or the error as text.
json Changed(const std::string& document, const std::string& setting) {
  json root = json::parse(document);
  const absl::StatusOr<JsonOverride> change = ParseOverride(setting);
  if (!change.ok()) return std::string(change.status().message());
  const absl::Status status = ApplyOverride(*change, &root);
  if (!status.ok()) return std::string(status.message());
  return root;
}

TEST(JsonOverrideTest, ReplacesAValue) {
  EXPECT_EQ(Changed(R"({"a": {"b": [1, 2]}})", "/a/b/1=3.5e2"),
            json::parse(R"({"a": {"b": [1, 350.0]}})"));
}

TEST(JsonOverrideTest, TakesWhatIsNotJsonAsAString) {
  EXPECT_EQ(Changed(R"({"a": 1})", "/a=box"), json::parse(R"({"a": "box"})"));
  EXPECT_EQ(Changed(R"({"a": 1})", "/a="), json::parse(R"({"a": ""})"));
}

TEST(JsonOverrideTest, TakesAWholeObject) {
  EXPECT_EQ(Changed(R"({"a": 1})", R"(/a={"b": [true]})"),
            json::parse(R"({"a": {"b": [true]}})"));
}

TEST(JsonOverrideTest, KeepsFurtherEqualsSignsInTheValue) {
  EXPECT_EQ(Changed(R"({"a": 1})", "/a=x=y"), json::parse(R"({"a": "x=y"})"));
}

TEST(JsonOverrideTest, AddsAKeyAndTheObjectsAroundIt) {
  EXPECT_EQ(Changed("{}", "/output/every=5"),
            json::parse(R"({"output": {"every": 5}})"));
}

TEST(JsonOverrideTest, UnescapesThePointer) {
  EXPECT_EQ(Changed(R"({"a/b~c": 1})", "/a~1b~0c=2"),
            json::parse(R"({"a/b~c": 2})"));
}

TEST(JsonOverrideTest, RejectsAnElementThatDoesNotExist) {
  const std::string document = R"({"a": [1, 2]})";
  EXPECT_EQ(Changed(document, "/a/2=0"),
            "/a/2: no such element, /a has 2 (counted from 0)");
  for (const char* index : {"-", "01", "-1", "1x", "99999999999999999999"}) {
    EXPECT_EQ(Changed(document, std::string("/a/") + index + "=0"),
              std::string("/a/") + index +
                  ": no such element, /a has 2 (counted from 0)");
  }
}

TEST(JsonOverrideTest, RejectsAPlaceInsideANumber) {
  EXPECT_EQ(Changed(R"({"a": 1.5})", "/a/b=0"),
            "/a/b: no such place, /a is 1.5");
}

TEST(JsonOverrideTest, RejectsTextThatIsNotUtf8) {
  for (const char* bad :
       {"\xDF", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82"}) {
    EXPECT_THAT(Changed("{}", absl::StrCat("/a=x", bad)),
                HasSubstr("must be UTF-8, got \"/a=x"));
    EXPECT_THAT(Changed("{}", absl::StrCat("/x", bad, "=1")),
                HasSubstr("must be UTF-8, got \"/x"));
  }
  EXPECT_EQ(Changed("{}", "/\xC3\x9F=\xE2\x82\xAC\"")["\xC3\x9F"],
            "\xE2\x82\xAC\"");
}

TEST(JsonOverrideTest, RejectsWhatIsNotPointerAndValue) {
  for (const char* setting :
       {"", "=", "/", "/=1", "a=1", "/a", "/a~=1", "/a~2=1"}) {
    EXPECT_EQ(Changed("{}", setting),
              "must have the form /json/pointer=value, got \"" +
                  std::string(setting) + "\"");
  }
}

}  // namespace
}  // namespace emmy
