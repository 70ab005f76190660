// Estimates of the memory of values outside of themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "core/state.hpp"

namespace xr3 {

inline std::size_t heap_of(const std::vector<Block>& blocks) {
  std::size_t bytes = blocks.capacity() * sizeof(Block);
  for (const Block& block : blocks) bytes += block.name.capacity();
  return bytes;
}

inline std::size_t heap_of(const TipPath& path) { return path.points.capacity() * sizeof(PointUm); }

}  // namespace xr3
