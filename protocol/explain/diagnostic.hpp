// Diagnostics as text: a stable code and one sentence for every problem in the bytes of a line,
// every warning of the machine, and the problems of a line that none of its bytes caused. The log
// and the monitor port use them.
#pragma once

#include <string>
#include <string_view>

#include "core/event.hpp"
#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"

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

/// The warning and its remedy, without a full stop.
std::string text_of(const Warning& warning, const Model& model);

/// A letter as a text.
inline std::string letter_text(char letter) { return {letter}; }

/// `disabled`: a line was opened while the simulator is disabled.
ProblemNote disabled_note();

/// `pty_cooked`: the program's settings of the pseudo-terminal make it echo, or edit lines.
ProblemNote cooked_note();

/// `byte_clock_hurry`: with the byte clock, a joint gets motion commands and is never asked whether
/// it has arrived.
ProblemNote hurry_note(char label);

/// `device_silent`: the device did not answer an inquiry of the line in time.
ProblemNote silent_note(const Command& inquiry);

}  // namespace xr3
