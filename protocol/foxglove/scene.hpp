// The messages of the picture, foxglove.SceneUpdate as JSON on one line: the links of the robot,
// and the blocks. Each message shows all of its topic, so that the last one is enough.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/foxglove/time.hpp"
#include "protocol/scene/links.hpp"

namespace xr3::foxglove {

/// The solids of the links, each in its own frame: they follow the transforms.
std::string scene_text(const std::vector<SceneLink>& links, Nanoseconds time);

/// A block in the frame with which it moves.
struct PlacedBlock {
  Block block;
  std::string frame;  ///< `base`, `tool` if the jaws hold it, `carousel` if it rides there
  Transform pose;     ///< in the frame, lengths in mm
  bool operator==(const PlacedBlock&) const = default;
};

/// All blocks. Equal as long as each one stays where it lies, in the jaws, or on the carousel.
std::vector<PlacedBlock> placed_blocks(const Model& model, const State& state);

std::string blocks_text(const std::vector<PlacedBlock>& blocks, Nanoseconds time);

}  // namespace xr3::foxglove
