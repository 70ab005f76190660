#include "tests/fuzz/common/chunks.hpp"

#include <algorithm>

namespace xr3::fuzz {

std::vector<Chunk> chunks_of(std::string_view input, Tick most) {
  std::vector<Chunk> chunks;
  while (!input.empty()) {
    const auto c = static_cast<unsigned char>(input[0]);
    input.remove_prefix(1);
    if (c >= 0x80) {
      const Tick root = c - 0x7f;
      const Tick ticks = std::min(most, root * root);
      chunks.push_back({0, {}, ticks});
      most -= ticks;
      continue;
    }
    const std::size_t size = std::min<std::size_t>(input.size(), (c & 0x3fU) + 1);
    chunks.push_back({c < 0x40 ? 1 : 2, input.substr(0, size), 0});
    input.remove_prefix(size);
  }
  return chunks;
}

}  // namespace xr3::fuzz
