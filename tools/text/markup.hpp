// Text within HTML and XML: printable, see protocol/text/printable.hpp.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "protocol/text/printable.hpp"

namespace xr3 {

/// Text in HTML, between tags or in quotes.
inline std::string html(std::string_view text) {
  std::string result;
  for (const char c : printable_lines(text)) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

/// Text in XML, with its line feeds and tabs.
inline std::string xml_lines(std::string_view text) { return html(text); }

/// Text in XML, on one line: line feeds and tabs become blanks.
inline std::string xml(std::string_view text) {
  std::string result = xml_lines(text);
  std::ranges::replace_if(
      result, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return result;
}

}  // namespace xr3
