// Moves the blocks of a workcell at random, so that a program cannot know where they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/robot.hpp"
#include "core/units.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// Limits for moving and turning blocks from the places in their file.
struct Variation {
  std::uint64_t seed = 0;
  Micrometres most_um = 40'000;
  Microdegrees most_udeg = 180'000'000;
  bool operator==(const Variation&) const = default;
};

/// Parses `SEED`, `SEED:MM` or `SEED:MM,DEG`. Throws std::invalid_argument, with the allowed form.
Variation parse_variation(const std::string& text);

/// The workcell with each block that lies on the work surface moved and turned at random: within
/// reach of the robot, in the camera's field if there is one, and 5 mm apart from others. A seed
/// gives the same places on every machine. nullopt if no place was found for a block.
std::optional<Workcell> varied(const Workcell& workcell, const Robot& robot,
                               const Variation& variation);

}  // namespace xr3
