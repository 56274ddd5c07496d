#include "emmy/model/validation.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "absl/strings/str_format.h"
#include "tests/support/random_source.h"

namespace emmy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ValidationTest, PositiveAcceptsTheSmallestAndTheLargestNumber) {
  EXPECT_TRUE(
      CheckPositive("/x", std::numeric_limits<double>::denorm_min(), "m").ok());
  EXPECT_TRUE(
      CheckPositive("/x", std::numeric_limits<double>::max(), "m").ok());
}

TEST(ValidationTest, PositiveRejectsZeroAndWhatIsNotFinite) {
  for (const double value : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(CheckPositive("/x", value, "m").ok()) << value;
  }
}

TEST(ValidationTest, NotNegativeAcceptsZero) {
  EXPECT_TRUE(CheckNotNegative("/x", 0.0, "kg").ok());
  EXPECT_EQ(CheckNotNegative("/x", -1.0, "kg").message(),
            "/x: must be a finite number >= 0 [kg], got -1");
  EXPECT_FALSE(CheckNotNegative("/x", kNan, "kg").ok());
  EXPECT_FALSE(CheckNotNegative("/x", kInfinity, "kg").ok());
}

TEST(ValidationTest, FiniteNamesTheEntryAtFault) {
  EXPECT_EQ(CheckFinite("/v", {1.0, kNan, kNan}, "m/s").message(),
            "/v/1: must be a finite number [m/s], got nan");
  EXPECT_TRUE(CheckFinite("/v", {1.0, -2.0, 0.0}, "m/s").ok());
}

TEST(ValidationTest, WithoutUnitThereAreNoBrackets) {
  EXPECT_EQ(CheckPositive("/n", -1.0, "").message(),
            "/n: must be a finite number > 0, got -1");
}

TEST(ValidationTest, NumberTextReadsBackAsTheSameNumber) {
  RandomSource random(20250402);
  for (int trial = 0; trial < 1000; ++trial) {
    const double value = random.Magnitude(1e-300, 1e300);
    EXPECT_EQ(std::strtod(NumberText(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(NumberText(0.1), "0.1");
}

// The character below U+0100 of that number.
std::string Utf8(int character) {
  if (character < 0x80) return std::string(1, static_cast<char>(character));
  return {static_cast<char>(0xC0 | (character >> 6)),
          static_cast<char>(0x80 | (character & 0x3F))};
}

TEST(ValidationTest, ControlCharactersAreNotPrintable) {
  for (int c = 0; c < 0x100; ++c) {
    const bool is_control = c < 0x20 || (c >= 0x7F && c < 0xA0);
    const std::string text = Utf8(c);
    EXPECT_EQ(IsPrintable("x" + text + "y"), !is_control) << c;
    EXPECT_EQ(
        NameText("x" + text + "y"),
        is_control ? absl::StrFormat("\"x\\u%04xy\"", c) : "\"x" + text + "y\"")
        << c;
  }
}

TEST(ValidationTest, LettersWithBytesOfControlCharactersArePrintable) {
  for (const std::string text : {"é", "„“", "日本", "€", "😀", "\xC2"}) {
    EXPECT_TRUE(IsPrintable(text)) << text;
    EXPECT_EQ(NameText(text), "\"" + text + "\"");
  }
}

}  // namespace
}  // namespace emmy
