// What a cell tells, in words: a stable code and one plain sentence for every event. The log and the
// monitor port say the same.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/cell_event.hpp"

namespace xr3 {

/// `raw`, `telnet` or `monitor`.
std::string_view name_of(LineKind kind);

/// The stable code of an event, as in `reached`, `line_open`, `client_closed` or `pause`.
std::string_view code_of(const CellEvent& event);

/// One sentence on an event. `model` gives units and limits.
std::string describe(const CellEvent& event, const Model& model);

}  // namespace xr3
