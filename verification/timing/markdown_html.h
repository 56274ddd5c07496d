// The timing report's Markdown as HTML, so that both say the same.

#ifndef EMMY_VERIFICATION_TIMING_MARKDOWN_HTML_H_
#define EMMY_VERIFICATION_TIMING_MARKDOWN_HTML_H_

#include <string>

namespace emmy::verification {

// What the reports use and no more: headings, paragraphs of one line, lists,
// tables, `code` and **strong**. Everything else is text.
std::string MarkdownHtml(const std::string& markdown);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_MARKDOWN_HTML_H_
