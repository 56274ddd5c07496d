#include "emmy/io/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace emmy {
namespace {

using ::testing::StartsWith;

std::string ParseError(const std::string& text) {
  const absl::StatusOr<nlohmann::json> json = ParseJson(text);
  return json.ok() ? "no error" : std::string(json.status().message());
}

TEST(ParseJsonTest, GivesTheSameValueAsTheLibrary) {
  const char* text = R"({"a": [1, -2, 3.5e-7, true, null, "ü\n"], "b": {}})";
  const absl::StatusOr<nlohmann::json> json = ParseJson(text);
  ASSERT_TRUE(json.ok()) << json.status();
  EXPECT_EQ(*json, nlohmann::json::parse(text));
}

TEST(ParseJsonTest, NamesTheSecondOfTwoEqualKeys) {
  EXPECT_EQ(ParseError(R"({"a": [{}, {"b": 1, "c": 2, "b": 1}]})"),
            "/a/1/b: duplicate key");
}

TEST(ParseJsonTest, SeesThatAKeyIsTheSameInAnotherSpelling) {
  EXPECT_EQ(ParseError(R"({"a": 1, "\u0061": 2})"), "/a: duplicate key");
}

TEST(ParseJsonTest, AllowsTheSameKeyInDifferentObjects) {
  EXPECT_TRUE(ParseJson(R"([{"a": {"a": 1}}, {"a": 1}])").ok());
}

TEST(ParseJsonTest, NamesThePlaceOfANumberThatIsNotFinite) {
  EXPECT_EQ(ParseError(R"({"a": {"b": [0, -1e999]}})"),
            "/a/b/1: must be a finite number, got -1e999");
}

TEST(ParseJsonTest, GivesLineAndColumnOfASyntaxError) {
  EXPECT_THAT(ParseError("{\n  \"a\": 1,\n  \"b\" 2\n}"),
              StartsWith("line 3, column 7: not valid JSON: "));
}

TEST(ParseJsonTest, CountsColumnsInCharactersNotBytes) {
  EXPECT_THAT(ParseError("{\"äöü\" 1}"), StartsWith("line 1, column 8: "));
}

TEST(ParseJsonTest, RejectsNanBecauseItIsNotJson) {
  EXPECT_THAT(ParseError(R"({"a": NaN})"),
              StartsWith("line 1, column 7: not valid JSON: "));
}

TEST(ParseJsonTest, RejectsATruncatedDocument) {
  EXPECT_THAT(ParseError(R"({"a": [1, 2)"),
              StartsWith("line 1, column 12: not valid JSON: "));
}

TEST(ParseJsonTest, RejectsTextAfterTheDocument) {
  EXPECT_THAT(ParseError("{}\n{}"),
              StartsWith("line 2, column 1: not valid JSON: "));
}

// To the JSON library a NUL is the end of the text.
TEST(ParseJsonTest, RejectsANulByteWhateverFollowsIt) {
  const std::string nul(1, '\0');
  EXPECT_EQ(ParseError("{}\n " + nul + "}}garbage{\"x\":"),
            "line 2, column 2: not valid JSON: a NUL byte");
  EXPECT_EQ(ParseError("{\"ä\": 1}" + nul),
            "line 1, column 9: not valid JSON: a NUL byte");
  EXPECT_EQ(ParseError(nul), "line 1, column 1: not valid JSON: a NUL byte");
  EXPECT_TRUE(ParseJson(R"({"a": "\u0000"})").ok());
}

TEST(ParseJsonTest, RejectsAnEmptyText) {
  EXPECT_EQ(ParseError(""), "empty, must be a JSON object");
  EXPECT_EQ(ParseError(" \n"), "empty, must be a JSON object");
}

TEST(ParseJsonTest, RejectsInvalidUtf8WithAPrintableMessage) {
  const std::string message = ParseError("{\"a\": \"\xff\xfe\"}");
  EXPECT_THAT(message, StartsWith("line 1, column 8: not valid JSON: "));
  for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(ParseJsonTest, AcceptsNestingUpToTheLimitAndRejectsMore) {
  const auto nested = [](size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_TRUE(ParseJson(nested(kMaxJsonDepth)).ok());
  EXPECT_THAT(ParseError(nested(kMaxJsonDepth + 1)),
              ::testing::EndsWith(": nested deeper than 32 levels"));
}

TEST(ParseJsonTest, RejectsAMillionOpenBracketsWithAShortMessage) {
  EXPECT_LT(ParseError(std::string(1000000, '[')).size(), 200u);
}

TEST(ParseJsonTest, ShortensALongKeyInAMessage) {
  const std::string key(100000, 'k');
  EXPECT_LT(ParseError("{\"" + key + "\": 1, \"" + key + "\": 1}").size(),
            100u);
}

TEST(ParseJsonTest, RejectsATextAboveTheSizeLimit) {
  EXPECT_EQ(ParseError(std::string(kMaxJsonBytes + 1, ' ')),
            "larger than 256 MiB");
}

TEST(FormatJsonTest, KeepsOnOneLineWhatFits) {
  const auto json = nlohmann::ordered_json::parse(
      R"({"z": [0, 0.001, -9.81], "a": {"b": "text"}, "e": [], "f": {}})");
  EXPECT_EQ(
      FormatJson(json),
      R"({"z": [0, 0.001, -9.81], "a": {"b": "text"}, "e": [], "f": {}})");
}

TEST(FormatJsonTest, BreaksWhatIsLongerThanALine) {
  const std::string text(60, 'x');
  const nlohmann::ordered_json json = {
      {"text", text}, {"list", {1, 2, 3}}, {"more", text}};
  EXPECT_EQ(FormatJson(json),
            "{\n  \"text\": \"" + text +
                "\",\n  \"list\": [1, 2, 3],\n  \"more\": \"" + text + "\"\n}");
}

TEST(FormatJsonTest, KeepsEveryBitOfADouble) {
  for (const double x :
       {0.1, 1.0 / 3.0, -0.0, 5e-324, 1e23, 7e10, 1e-3,
        std::numeric_limits<double>::max(),
        std::numeric_limits<double>::denorm_min(), 0.1 + 0.2}) {
    const absl::StatusOr<nlohmann::json> back =
        ParseJson(FormatJson(nlohmann::ordered_json(x)));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->get<double>(), x);
    EXPECT_EQ(std::signbit(back->get<double>()), std::signbit(x));
  }
}

TEST(ShortenTest, CutsBetweenCharacters) {
  EXPECT_EQ(Shorten("abcdef", 6), "abcdef");
  EXPECT_EQ(Shorten("abcdefg", 6), "abc...");
  EXPECT_EQ(Shorten("abüdefgh", 6), "ab...");
}

TEST(PointerPartTest, EscapesSlashTildeAndControlCharacters) {
  EXPECT_EQ(PointerPart("a/b~c\n"), "/a~1b~0c\\n");
}

// Found by tools/fuzz: JSON text may hold U+007F unescaped, and what follows.
TEST(ShowJsonTest, LeavesNoControlCharacter) {
  EXPECT_EQ(ShowJson("é\xC2\x80„\xC2\x9F"), "\"é\\u0080„\\u009f\"");
  EXPECT_EQ(PointerPart("é\xC2\x80„"), "/é\\u0080„");
  EXPECT_EQ(ShowJson("a\x7F\n"), "\"a\\u007f\\n\"");
  EXPECT_EQ(PointerPart("a\x7F\n"), "/a\\u007f\\n");
}

}  // namespace
}  // namespace emmy
