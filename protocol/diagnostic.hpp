// Silence on the line explained: a stable code and one plain sentence for every ignored or surprising
// byte, and for every event of the machine. The words of the log and of the monitor port.
#pragma once

#include <string>
#include <string_view>

#include "core/event.hpp"
#include "core/model.hpp"
#include "protocol/rhino_endpoint.hpp"

namespace xr3 {

/// The stable code, as in `number_out_of_range`.
std::string_view code_of(ProblemCode code);
std::string_view code_of(WarningCode code);
/// The stable code of an event, as in `reached`.
std::string_view code_of(const EventBody& event);

/// A number with its sign: `+5`, `-3`, `+0`.
std::string signed_number(int value);

/// Bytes for people: printable as they are, the others as \r, \n, \0 or \x1b.
std::string readable(std::string_view bytes);

/// Two hexadecimal digits a byte.
std::string hexadecimal(std::string_view bytes);

/// What was wrong and what is allowed, opened by the bytes themselves.
std::string describe(const Parsed& parsed, const Problem& problem);

/// One sentence on an event. `model` gives units and limits.
std::string describe(const EventBody& event, const Model& model);

}  // namespace xr3
