#include "tools/term/hex_text.hpp"

#include "protocol/explain/diagnostic.hpp"

namespace xr3::term {

std::string hex_lines(char mark, std::string_view bytes) {
  constexpr std::size_t kBytesOfLine = 16;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (at % kBytesOfLine == 0) text += (at == 0 ? "" : "\n") + std::string(1, mark);
    text += " " + hexadecimal(bytes.substr(at, 1));
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace xr3::term
