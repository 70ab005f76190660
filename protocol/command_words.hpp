// What a command of the serial line does, in words: a stable name and one plain phrase. It speaks of
// commands that were carried out; what is wrong with others is the diagnostics' business.
#pragma once

#include <string>
#include <string_view>

#include "protocol/wire_record.hpp"

namespace xr3 {

/// The stable name, as in `move` or `query_error`: that of data/commands.json.
std::string_view code_of(const Command& command);

/// What the command did or asks for, as in `move E +5, counter 5`.
std::string describe(const wire::Obeyed& obeyed);

}  // namespace xr3
