// Text, numbers and files as parts of an HTML page.

#ifndef EMMY_VERIFICATION_REPORT_HTML_TEXT_H_
#define EMMY_VERIFICATION_REPORT_HTML_TEXT_H_

#include <string>
#include <string_view>

namespace emmy::verification {

// For text and for attributes in either kind of quotes, in HTML and in XML;
// control characters, which XML has not, become U+FFFD.
std::string EscapeHtml(std::string_view text);

// A number as people write it, "3.21 × 10⁻¹⁶", "1.9998", in an element <data>
// whose value has all digits; NaN is a word, infinities are signs.
std::string HtmlNumber(double value);

// RFC 4648, with padding.
std::string Base64(std::string_view bytes);

// "data:<type>;base64,…": `type` is a media type such as "image/svg+xml".
std::string DataUri(std::string_view type, std::string_view bytes);

// From the document type to </head>, with the report's style in it: a page that
// loads nothing, "Emmy: <title>", and runs a script only if it `has_script`.
std::string HtmlHead(std::string_view title, bool has_script);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_HTML_TEXT_H_
