// Text within HTML and XML: printable, see protocol/text/printable.hpp.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "protocol/text/printable.hpp"

namespace xr3 {

/// Text in HTML or XML, between tags or in quotes, with its line feeds and tabs.
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

/// Text in an attribute of XML, on one line: line feeds and tabs become blanks.
inline std::string xml(std::string_view text) {
  std::string result = html(text);
  std::ranges::replace_if(
      result, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return result;
}

}  // namespace xr3
