// The characters of UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <string_view>

namespace xr3 {

/// Size of the character outside ASCII at the start of a text, or 0 if there is none or it is
/// invalid.
std::size_t utf8_length(std::string_view text);

}  // namespace xr3
