// Commands, replies and states as text, for tables of expectations and for failure messages. A
// command is written as its shortest bytes, a problem as its code: "E+5", "A*3*", "unknown_byte".
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/command.hpp"
#include "core/state.hpp"
#include "protocol/line/rhino_parser.hpp"

namespace xr3 {
namespace test {

std::string words(const Command& command);
std::string words(const Parsed& parsed);
/// Separated by blanks.
std::string words(const std::vector<Parsed>& parsed);
std::string words(const Reply& reply);
std::string words(const State& state);

}  // namespace test

// GoogleTest finds these by their arguments.
void PrintTo(const State& state, std::ostream* out);
void PrintTo(const Reply& reply, std::ostream* out);
void PrintTo(const Parsed& parsed, std::ostream* out);

}  // namespace xr3
