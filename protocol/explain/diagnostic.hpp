// Diagnostics as text: a stable code and one sentence for every problem in the bytes of a line. The
// log and the monitor port use them.
#pragma once

#include <string>
#include <string_view>

#include "core/event.hpp"
#include "protocol/line/rhino_endpoint.hpp"

namespace xr3 {

/// The stable code, such as `number_out_of_range`.
std::string_view code_of(ProblemCode code);
std::string_view code_of(WarningCode code);

/// A number with its sign: `+5`, `-3`, `+0`.
std::string signed_number(int value);

/// Bytes in readable form: printable ASCII unchanged, the others as \r, \n, \0 or \x1b.
std::string readable(std::string_view bytes);

/// Two hexadecimal digits per byte.
std::string hexadecimal(std::string_view bytes);

/// The bytes, what is wrong with them, and what is allowed.
std::string describe(const Parsed& parsed, const Problem& problem);

}  // namespace xr3
