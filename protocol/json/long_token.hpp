// Finds a text or number in JSON that is wrong and very long, before the parser does: it would copy all of it
// into its message, several times. What is shorter is left to the parser.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace xr3 {

/// Longer ones are looked at, in bytes.
inline constexpr std::size_t kLongToken = 4096;

struct LongToken {
  std::size_t begin;   ///< where it begins in the text
  std::string sample;  ///< a short JSON text with the same fault
  std::size_t offset;  ///< what to add to a position in the sample for the one in the text
};

/// The first long token that the parser would refuse.
std::optional<LongToken> find_wrong_long_token(std::string_view text);

/// The quote that ends a text, whose first letter would be at an offset; or the end of all.
std::size_t text_end(std::string_view text, std::size_t at);

}  // namespace xr3
