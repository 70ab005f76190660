// Inputs of fuzzers as bytes on two serial lines and passing time. A chunk begins with a byte c:
// c < 0x40 sends the next c + 1 bytes on line 1, c < 0x80 the next c - 0x3f on line 2, else
// (c - 0x7f)^2 ticks pass.
#pragma once

#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace xr3::fuzz {

struct Chunk {
  int wire = 0;  ///< 1 or 2; 0: time passes
  std::string_view bytes;
  Tick ticks = 0;
};

/// The chunks of an input, in total at most `most` ticks.
std::vector<Chunk> chunks_of(std::string_view input, Tick most);

}  // namespace xr3::fuzz
