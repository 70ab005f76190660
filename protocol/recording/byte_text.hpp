// Bytes in JSON: a string with one code point U+0000 to U+00FF for each byte.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/json/codec.hpp"

namespace xr3::recording {

/// Appends the string in quotes, in ASCII.
void append_byte_text(std::string_view bytes, std::string& json);

/// At most `most` bytes.
data::Codec<std::string> byte_text(std::size_t most);

}  // namespace xr3::recording
