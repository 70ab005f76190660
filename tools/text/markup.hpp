// Text within HTML and XML.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace xr3 {

/// Text in HTML, between tags or in quotes.
inline std::string html(std::string_view text) {
  std::string result;
  for (const char c : text) {
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

/// Text in XML. Control characters, which it does not have, not even escaped, become blanks.
inline std::string xml(std::string_view text) {
  std::string result = html(text);
  const auto is_control = [](unsigned char c) { return c < ' '; };
  std::ranges::replace_if(result, is_control, ' ');
  return result;
}

}  // namespace xr3
