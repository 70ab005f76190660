// Blocks and jaws (paper, Section III-B). Jaws that close on a block turn it flat against the
// fingers and hold it; the first opening count releases it. At most one block is held. There is no
// gravity.
#pragma once

#include "core/event.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The pose of a block that is not held; see block_pose().
Transform lying_pose(const Block& block);

/// T(0,block) in mm: the block's frame (x along its length, origin at the centroid) in the base
/// frame. A held block is fixed in the tool's frame and tilts with it.
Transform block_pose(const Model& model, const State& state, std::size_t block);

/// The effect of the next closing count of the tool's motor.
struct JawContact {
  enum class Kind : std::uint8_t {
    kFree,       ///< no block between the jaws, or enough room
    kTurns,      ///< the count is made and turns the block flat against the jaws
    kHolds,      ///< the count is not made: the jaws hold the block
    kTooNarrow,  ///< the count is made; the opening is already narrower than the block
  };
  Kind kind = Kind::kFree;
  std::uint32_t block = 0;
  int quarter_turns = 0;
  bool operator==(const JawContact&) const = default;
};

/// `positions` are those before the count.
JawContact next_closing(const Model& model, const State& state, const Positions& positions);

/// Whether a count of the tool's motor in this direction opens the jaws.
bool opens_jaws(const Model& model, int direction);

/// Turns, holds or releases a block after the motors have moved. `contact` is the contact of the
/// tool's motor in this tick; `opened`: it made an opening count.
void update_grasp(const Model& model, State& state, const Positions& positions,
                  const JawContact& contact, bool opened, Events& events);

/// The held block as it would lie if released at `positions`: centroid at the tip, upright, yaw
/// from the net roll.
Block as_released(const Model& model, const State& state, const Held& held,
                  const Positions& positions);

/// The opening that a block needs when held: its width, or its length for odd quarter turns.
Micrometres flat_extent_um(const Block& block, int quarter_turns);

/// Whether jaws at the grasp's tool position can hold this block: they are wide enough for it, and
/// the next closing count, which must be within the limits, would be too narrow.
bool can_hold(const Model& model, const Block& block, const Held& held);

/// Warns if the jaws stopped at the width of a block, so that the next closing count would hold it
/// (`jaws_touch`). Call when a closing move has ended.
void warn_of_touch(const Model& model, const State& state, const Positions& positions,
                   Events& events);

/// Lets the held block fall out of the jaws, onto what is below it, if that is further away than
/// half of its height; otherwise the jaws would hold it again. Returns whether it fell.
bool drop(const Model& model, State& state, const Positions& positions, Events& events);

/// Releases the held block, see as_released(), and warns if it lies badly, see
/// warn_of_placement(). Does nothing if none is held.
void release(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
