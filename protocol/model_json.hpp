// The `model` message's members: robot and workcell in the form of their data files, the blocks where
// they are now. A pure function of model and state; what identifies a model comes from the caller.
#pragma once

#include <string_view>

#include "core/model.hpp"
#include "core/state.hpp"
#include "core/workcell.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// The model's workcell with the state's blocks; a held one as it would lie if it were let go now, since a
/// file's blocks stand upright. Kept as a file it starts a cell whose blocks are just there.
Workcell workcell_now(const Model& model, const State& state);

/// Every member of a `model` message but op, cell, epoch, seq and tick. `rev` counts the workcells since
/// the start; `hash` is `sha256:` and hexadecimal digits.
Json model_json(const Model& model, const State& state, int rev, std::string_view hash);

}  // namespace xr3
