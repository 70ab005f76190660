// Estimates of the memory of values outside of themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

inline std::size_t heap_of(const std::vector<Block>& blocks) {
  std::size_t bytes = blocks.capacity() * sizeof(Block);
  for (const Block& block : blocks) bytes += block.name.capacity();
  return bytes;
}

inline std::size_t heap_of(const TipPath& path) {
  return path.points.all().capacity() * sizeof(PointUm);
}

inline std::size_t heap_of(const Workcell& workcell) {
  return workcell.name.capacity() + workcell.notes.capacity() + heap_of(workcell.blocks);
}

/// At most: each joint may have a table, beside which its part of the robot is small.
inline std::size_t heap_of(const Model& model) {
  const auto joints = static_cast<std::size_t>(model.joint_count());
  return joints * SinCosTable::kMaxTableBytes + heap_of(model.workcell());
}

}  // namespace xr3
