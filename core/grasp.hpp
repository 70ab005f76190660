// Blocks and jaws (paper, Section III-B): jaws that close on a block turn it flat and hold it; the
// first opening count lets it go. No gravity; one block at most is held; none is ever lost.
#pragma once

#include "core/event.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// T(0,block): the block's own frame (x along its length, origin at the centroid) in the base frame,
/// in mm. A held block is rigid in the tool's frame, tilt included.
Transform block_pose(const Model& model, const State& state, std::size_t block);

/// What the next closing count of the tool's motor would do.
struct JawContact {
  enum class Kind : std::uint8_t {
    kFree,       ///< nothing is between the jaws, or there is room
    kTurns,      ///< the count happens and turns the block flat against the jaws
    kHolds,      ///< the count does not happen: the jaws stand against the block
    kTooNarrow,  ///< the count happens; the jaws are narrower than the block already
  };
  Kind kind = Kind::kFree;
  std::uint32_t block = 0;
  int quarter_turns = 0;
  bool operator==(const JawContact&) const = default;
};

/// Judged at the positions before the count.
JawContact next_closing(const Model& model, const State& state, const Positions& positions);

/// A count of the tool's motor in this direction opens the jaws.
bool opens_jaws(const Model& model, int direction);

/// After the motors have turned: turns, holds or releases a block. `contact` is what the tool's motor
/// met in this tick, `opened` that it made an opening count.
void update_grasp(const Model& model, State& state, const Positions& positions,
                  const JawContact& contact, bool opened, Events& events);

/// A held block as it would lie if it were let go where the tool is now: centroid at the tip, upright,
/// yaw by the net roll.
Block as_released(const Model& model, const State& state, const Held& held,
                  const Positions& positions);

/// What a block needs between the fingers, as they closed on it: its width, or for odd turns its length.
Micrometres flat_extent_um(const Block& block, int quarter_turns);

/// Jaws at the tool position of the grasp stand against this block: they leave it room, and the next
/// closing count, which the limits allow, would not.
bool stand_against(const Model& model, const Block& block, const Held& held);

/// Lets the held block go, see as_released(); nothing where none is held.
void release(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
