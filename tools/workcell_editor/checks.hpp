// The checks of the workcell dialogue: everything that the file loader finds, and blocks that the
// robot cannot grasp. Also the defaults that it proposes.
#pragma once

#include <string>

#include "core/inverse/reach.hpp"
#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/json/finding.hpp"

namespace xr3::dialogue {

/// A robot and its reach.
struct Arm {
  explicit Arm(Robot described) : robot(std::move(described)), reach(robot) {}
  Robot robot;
  Reach reach;
};

/// All errors and warnings of the loader for this workcell, and a warning for each block out of
/// reach.
Findings check(const Workcell& workcell, const Arm& arm);

/// The findings about one block, with `block` replacing block `index` (or added after the last).
Findings check_block(const Workcell& workcell, std::size_t index, const Block& block,
                     const Arm& arm);

/// One line per finding: `  ! "red": a block that...; allowed: ...`.
std::string notes(const Workcell& workcell, const Findings& findings);

/// A note if the block is too wide for the jaws; otherwise empty.
std::string jaws_note(const Block& block, const Robot& robot);

/// z of the block's centre if it lies on the work surface or on the blocks below it.
Micrometres resting_z(const Workcell& workcell, std::size_t index, Block block);

/// A workspace and work surface that suit the robot; no blocks, no camera.
Workcell proposed_workcell(const Arm& arm);
/// A block that the robot can grasp, away from the others, with a new name and colour.
Block proposed_block(const Workcell& workcell, const Arm& arm);
/// A camera above the centre of the workspace.
Camera proposed_camera(const Workcell& workcell);

}  // namespace xr3::dialogue
