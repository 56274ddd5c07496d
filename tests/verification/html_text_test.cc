#include "verification/report/html_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

TEST(EscapeHtmlTest, NothingOfTheTextIsMarkup) {
  EXPECT_EQ(EscapeHtml("<b a=\"1\" c='2'>&amp;</b>"),
            "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;&lt;/b&gt;");
  EXPECT_EQ(EscapeHtml("≤ |ω|"), "≤ |ω|");
}

TEST(EscapeHtmlTest, ControlCharactersAreReplaced) {
  EXPECT_EQ(EscapeHtml(std::string("a\0b\x1B\tc\n", 7)), "a\uFFFDb\uFFFD\tc\n");
}

TEST(HtmlNumberTest, ShowsAFewDigitsAndKeepsAll) {
  const std::string digits = "-8.8817841970012523e-16";
  EXPECT_EQ(HtmlNumber(-std::ldexp(1.0, -50)),
            "<data value=\"" + digits + "\" title=\"" + digits +
                "\">−8.88&#8239;×&#8239;10<sup>−16</sup></data>");
  EXPECT_THAT(HtmlNumber(0.1), HasSubstr("value=\"0.10000000000000001\""));
  EXPECT_THAT(HtmlNumber(1.99982), HasSubstr(">1.9998</data>"));
  EXPECT_THAT(HtmlNumber(-2.0), HasSubstr(">−2</data>"));
  EXPECT_THAT(HtmlNumber(0.0), HasSubstr(">0</data>"));
}

TEST(HtmlNumberTest, NamesWhatIsNoNumber) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(HtmlNumber(std::numeric_limits<double>::quiet_NaN()),
              HasSubstr(">NaN</data>"));
  EXPECT_THAT(HtmlNumber(kInfinity), HasSubstr(">∞</data>"));
  EXPECT_THAT(HtmlNumber(-kInfinity), HasSubstr(">−∞</data>"));
}

TEST(DataUriTest, IsBase64WithItsType) {
  EXPECT_EQ(DataUri("text/csv", "a,b\n"), "data:text/csv;base64,YSxiCg==");
}

}  // namespace
}  // namespace emmy::verification
