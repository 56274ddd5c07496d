#include "verification/report/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/well_formed.h"
#include "verification/report/theory_equations.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(FormulaTest, RaisedAndLoweredCharactersAreScripts) {
  EXPECT_EQ(FormulaHtml("ε₊²"),
            "<math><msubsup><mi>ε</mi><mrow><mo>+</mo></mrow>"
            "<mrow><mn>2</mn></mrow></msubsup></math>");
  EXPECT_EQ(FormulaHtml("x_ground"),
            "<math><msub><mi>x</mi><mrow><mtext>ground</mtext></mrow></msub>"
            "</math>");
  EXPECT_EQ(FormulaHtml("α^(−1)"),
            "<math><msup><mi>α</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>"
            "</math>");
}

TEST(FormulaTest, AccentsStandAboveWhatTheyFollow) {
  const std::string dot = "<math><mover><mi>e</mi><mo>˙</mo></mover></math>";
  EXPECT_EQ(FormulaHtml("ė"), dot);
  EXPECT_EQ(FormulaHtml("e\u0307"), dot);
}

TEST(FormulaTest, AStrokeIsAFractionOfWhatStandsNextToIt) {
  EXPECT_EQ(FormulaHtml("2 Δs/(a + b)"),
            "<math><mn>2</mn><mspace "
            "width=\"0.17em\"></mspace><mfrac "
            "displaystyle=\"true\"><mrow><mi>Δ</mi><mi>s</mi></mrow><mrow>"
            "<mi>a</mi><mo>+</mo><mi>b</mi></mrow></mfrac></math>");
}

TEST(FormulaTest, ParenthesesOfAListStayInAFraction) {
  EXPECT_THAT(FormulaHtml("(1, ½ Θ)/n"), HasSubstr(">(</mo>"));
  EXPECT_THAT(FormulaHtml("(a + b)/n"), Not(HasSubstr(">(</mo>")));
}

TEST(FormulaTest, WordsAreTextAndLinesMayEndAtEqualsSignsAndCommas) {
  EXPECT_EQ(FormulaHtml("a force f = 1, for sin x"),
            "a force <math><mi>f</mi></math> <math><mo "
            "lspace=\"0\">=</mo><mn>1</mn></math>"
            ", for <math><mi>sin</mi><mspace "
            "width=\"0.17em\"></mspace><mi>x</mi></math>");
}

TEST(FormulaTest, TagsAndRemarksInParenthesesAreText) {
  EXPECT_EQ(FormulaHtml("Δ by (QS-1), the rest (net force, round-off)"),
            "<math><mi>Δ</mi></math> by (QS-1), the rest (net force, "
            "round-off)");
}

TEST(FormulaTest, RootsAndBarsEnclose) {
  EXPECT_THAT(FormulaHtml("√(1 + x)"),
              HasSubstr("<msqrt><mn>1</mn><mo>+</mo><mi>x</mi></msqrt>"));
  EXPECT_THAT(FormulaHtml("|x|²"),
              HasSubstr("<msup><mrow><mo form=\"prefix\""));
}

TEST(FormulaTest, NothingBreaksIt) {
  for (const char* text :
       {"", "/", "a/", "((", ")", "|", "√", "^", "_", "²", "<&>", "\xFF\xC3",
        "a//b", "x_", "[(|", "1..2", "\u0304"}) {
    EXPECT_EQ(ProblemInMarkup(FormulaHtml(text)), "") << text;
  }
}

TEST(FormulaTest, EveryEquationOfTheTheoryIsRead) {
  ASSERT_GT(TheoryEquations().size(), 50U);
  for (const auto& [tag, text] : TheoryEquations()) {
    const std::string html = FormulaHtml(text);
    EXPECT_EQ(ProblemInMarkup(html), "") << tag;
    // What should have become an element and did not.
    for (const char* left : {"_", "²", "ᵀ", "₀", "ⁱ", "½", "√", "\u0304<"}) {
      EXPECT_THAT(html, Not(HasSubstr(left))) << tag << ": " << text;
    }
  }
}

}  // namespace
}  // namespace emmy::verification
