#include "verification/timing/markdown_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(MarkdownHtmlTest, MakesATableOfItsRowsWithoutTheDashes) {
  const std::string html =
      MarkdownHtml("| a | b |\n| --- | --- |\n| `x` | **missed** |\n");
  EXPECT_THAT(html, HasSubstr("<tr><th>a</th><th>b</th></tr>"));
  EXPECT_THAT(html, HasSubstr("<tr><td><code>x</code></td>"
                              "<td><strong>missed</strong></td></tr>"));
  EXPECT_THAT(html, Not(HasSubstr("---")));
}

TEST(MarkdownHtmlTest, EscapesTextAndLeavesALoneMark) {
  EXPECT_EQ(MarkdownHtml("a < b ** c"), "<p>a &lt; b ** c</p>\n");
}

TEST(MarkdownHtmlTest, MakesHeadingsAndLists) {
  EXPECT_EQ(MarkdownHtml("### T\n\n- a\n- b\n"),
            "<h2>T</h2>\n<ul>\n<li>a</li>\n<li>b</li>\n</ul>\n");
}

}  // namespace
}  // namespace emmy::verification
