// The members of a `model` message: robot and workcell in the form of their data files, with the
// blocks at their current positions. A pure function of model and state; the caller supplies
// revision and hash.
#pragma once

#include <string_view>

#include "core/model.hpp"
#include "core/state.hpp"
#include "core/workcell.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// The model's workcell with the state's blocks. A held block is included as if released now, since
/// blocks in a file are upright. Saved as a file, it starts a cell with the blocks at these
/// positions.
Workcell workcell_now(const Model& model, const State& state);

/// All members of a `model` message except op, cell, epoch, seq and tick. `rev` counts the changes
/// of the workcell since the start; `hash` is `sha256:` and hexadecimal digits.
Json model_json(const Model& model, const State& state, int rev, std::string_view hash);

}  // namespace xr3
