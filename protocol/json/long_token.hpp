// Finds invalid long texts and numbers in JSON before the parser does, since the parser copies the
// token into its message several times. Shorter tokens are left to the parser.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace xr3 {

/// Only tokens longer than this are checked, in bytes.
inline constexpr std::size_t kLongToken = 4096;

struct LongToken {
  std::size_t begin;   ///< offset in the text
  std::string sample;  ///< a short JSON text with the same fault
  std::size_t offset;  ///< position in the text minus position in the sample
};

/// The first long token that the parser would refuse.
std::optional<LongToken> find_wrong_long_token(std::string_view text);

/// Offset of the quote that ends a text whose contents begin at `at`; text.size() if there is none.
std::size_t text_end(std::string_view text, std::size_t at);

}  // namespace xr3
