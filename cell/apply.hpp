// The inputs of a cell: one case each.
#pragma once

#include <functional>

#include "cell/input.hpp"
#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// Called between pieces of kMaxShownIn bytes of an input, with the byte clock between commands; if
/// true, the remaining bytes are not taken. May be empty.
using IsEnough = std::function<bool()>;

/// Applies an input at the cell's time. `now` is only for the clock, which a call may set.
Applied apply(CellState& cell, const Input& input, WallNs now, const IsEnough& is_enough,
              CellOutput& out);

/// Closed lines are known until more than these have closed.
inline constexpr std::size_t kRememberedLines = 1024;

}  // namespace xr3
