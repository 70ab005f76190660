// Commands of the serial line as text: a stable name and a short phrase. Only for executed
// commands; diagnostic.hpp has the texts for the others.
#pragma once

#include <string>
#include <string_view>

#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// The stable name used in data/commands.json, such as `move` or `query_error`.
std::string_view code_of(const Command& command);

/// What the command did or asks for, such as `move E +5, counter 5`.
std::string describe(const wire::Executed& obeyed);

}  // namespace xr3
