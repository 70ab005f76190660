// Base64 (RFC 4648), by nettle.
#pragma once

#include <string>
#include <string_view>

namespace xr3 {

std::string to_base64(std::string_view bytes);

}  // namespace xr3
