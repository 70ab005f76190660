// The input format of the fuzzers of byte streams: how the bytes of a client arrive. make_seeds.py
// writes the same format.
//
// Input: chunks that begin with a byte c. c < 0xf0: the next c + 1 bytes are a piece. Otherwise the
// next byte, repeated (c - 0xef) * 32 KiB, is a piece: so a short input reaches the limits of size.
// With kQuick it is repeated only (c - 0xef) * 32 times, and what follows the fourth piece is one
// piece. Input beyond the total is cut off.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/common/fuzz.hpp"

namespace xr3::fuzz {

using Pieces = std::vector<std::string>;

/// The longest input of these fuzzers, and the most bytes of the pieces with kQuick.
inline constexpr std::size_t kMaxStreamInput = 256;
inline constexpr std::size_t kMaxQuickBytes = 640;

/// The pieces of an input, in total at most `most` bytes.
Pieces pieces_of(std::string_view input, Effort effort, std::size_t most);

/// All pieces as one.
std::string joined(const Pieces& pieces);

}  // namespace xr3::fuzz
