// What the workcell's dialogue tells of a workcell that is being made: everything that the file's
// loader finds, and blocks that the robot cannot grasp; and what it proposes where nothing is given.
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/finding.hpp"
#include "protocol/workcell_dialogue_reach.hpp"

namespace xr3::dialogue {

/// A robot as the dialogue needs it.
struct Arm {
  explicit Arm(Robot described) : robot(std::move(described)), reach(robot) {}
  Robot robot;
  Reach reach;
};

/// All that is found in the workcell as a file, and blocks out of reach; warnings among it.
Findings check(const Workcell& workcell, const Arm& arm);

/// What is found of one block, `block` standing in the place of block `index` (or after the last).
Findings check_block(const Workcell& workcell, std::size_t index, const Block& block,
                     const Arm& arm);

/// A line each: `  ! "red": a block that...; allowed: ...`.
std::string notes(const Workcell& workcell, const Findings& findings);

/// Nothing, or a note that the jaws do not open so far.
std::string jaws_note(const Block& block, const Robot& robot);

/// The height of a block's middle with the block on the work surface, or on the blocks under it.
Micrometres resting_z(const Workcell& workcell, std::size_t index, Block block);

/// A workspace and work surface that suit the robot; no blocks, no camera.
Workcell proposed_workcell(const Arm& arm);
/// A block that the robot can grasp, apart from the others, with a name and a colour of its own.
Block proposed_block(const Workcell& workcell, const Arm& arm);
/// A camera over the middle of the workspace.
Camera proposed_camera(const Workcell& workcell);

}  // namespace xr3::dialogue
