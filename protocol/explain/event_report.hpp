// The report of an event of a cell: kind, stable code, one sentence, and the members of the
// monitor's message. One function per kind of event defines all of them; the log, the monitor port
// and the explanations of bytes use the same report.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

struct EventReport {
  std::string_view event;  ///< the kind, such as `blocked` or `warning`
  std::string_view code;   ///< stable, such as `limit` or `counter_overflow`
  std::string message;     ///< one sentence
  Json::object_t members;  ///< members that only this kind has
};

/// The report about an event of the machine. `model` gives units and limits.
EventReport report(const EventBody& event, const Model& model);

/// The report about any event of a cell.
EventReport report(const CellEvent& event, const Model& model);

/// The name in messages: `tcp`, `telnet`, `rfc2217`, `pty`, `device` or `monitor`.
std::string_view name_of(LineKind kind);

/// The stable code, such as `client_closed`.
std::string_view code_of(LineCloseReason reason);

}  // namespace xr3
