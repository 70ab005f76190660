// Bytes of both directions as hexadecimal text.
#pragma once

#include <string>
#include <string_view>

namespace xr3::term {

/// Lines of at most 16 bytes such as `> 45 3f 0d`, each with a line feed; `mark` is > for bytes
/// sent and < for bytes received.
std::string hex_lines(char mark, std::string_view bytes);

}  // namespace xr3::term
