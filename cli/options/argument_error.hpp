// Describes an error in the arguments of a command in one sentence: the first one in the order
// typed, with the name that was probably meant.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <string>
#include <vector>

namespace xr3 {

/// The sentence, printable, without `xr3: ` and a final line feed; a list of the commands may
/// follow. `arguments` are those of the program.
std::string describe_argument_error(const CLI::App& app, const CLI::ParseError& error,
                                    const std::vector<std::string>& arguments);

}  // namespace xr3
