// Events of a cell as text: a stable code and one sentence for every event. The log and the monitor
// port use the same texts.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// `raw`, `telnet` or `monitor`.
std::string_view name_of(LineKind kind);

/// The stable code of an event, such as `reached`, `line_open`, `client_closed` or `pause`.
std::string_view code_of(const CellEvent& event);

/// One sentence about an event. `model` gives units and limits.
std::string describe(const CellEvent& event, const Model& model);

}  // namespace xr3
