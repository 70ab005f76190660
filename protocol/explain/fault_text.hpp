// Faults on demand as text: the names of their kinds, and one sentence for each event of a fault.
#pragma once

#include <string>
#include <string_view>

#include "core/event.hpp"

namespace xr3 {

/// The stable name in files, calls and events, such as `encoder_slip`.
std::string_view code_of(FaultKind kind);

/// `set`, `cleared`, `began`, `ended` or `effect`.
std::string_view code_of(FaultPhase phase);

/// One sentence about the event, which begins with the fault's name.
std::string text_of(const FaultNews& news);

}  // namespace xr3
