#include "verification/report/html_text.h"

#include <cmath>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "verification/report/embedded.h"

namespace emmy::verification {

std::string EscapeHtml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\'') {
      escaped += "&#39;";
    } else if (byte == 127 ||
               (byte < 32 && c != '\n' && c != '\t' && c != '\r')) {
      escaped += "\xEF\xBF\xBD";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string HtmlNumber(double value) {
  // An order of convergence needs more digits than a round-off error.
  const double size = std::abs(value);
  const int num_digits = size >= 0.1 && size < 1e5 ? 5 : 3;
  std::string shown = absl::StrFormat("%.*g", num_digits, value);
  if (std::isnan(value)) {
    shown = "NaN";
  } else if (std::isinf(value)) {
    shown = value > 0.0 ? "∞" : "−∞";
  } else {
    const size_t at = shown.find('e');
    if (at != std::string::npos) {
      const int exponent = std::stoi(shown.substr(at + 1));
      shown = absl::StrCat(
          shown.substr(0, at), "&#8239;×&#8239;10<sup>",
          absl::StrReplaceAll(absl::StrCat(exponent), {{"-", "−"}}), "</sup>");
    }
    shown = absl::StrReplaceAll(shown, {{"-", "−"}});
  }
  const std::string digits = absl::StrFormat("%.17g", value);
  return absl::StrCat("<data value=\"", digits, "\" title=\"", digits, "\">",
                      shown, "</data>");
}

std::string Base64(std::string_view bytes) {
  return absl::Base64Escape(absl::string_view(bytes.data(), bytes.size()));
}

std::string DataUri(std::string_view type, std::string_view bytes) {
  return absl::StrCat("data:", absl::string_view(type.data(), type.size()),
                      ";base64,", Base64(bytes));
}

std::string HtmlHead(std::string_view title, bool has_script) {
  return absl::StrCat(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">"
      "\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src "
      "&#39;none&#39;; img-src data:; style-src &#39;unsafe-inline&#39;",
      has_script ? "; script-src &#39;unsafe-inline&#39;" : "",
      "\">\n<link rel=\"icon\" href=\"data:,\">\n<title>Emmy: ",
      absl::string_view(title.data(), title.size()), "</title>\n<style>\n",
      absl::string_view(EmbeddedStyle().data(), EmbeddedStyle().size()),
      "</style>\n</head>\n");
}

}  // namespace emmy::verification
