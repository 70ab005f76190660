// The first line of a script, when the script cannot be started.
#pragma once

#include <string>

namespace xr3 {

/// The reason why the interpreter in the first line of a script is not found, as a part of a
/// sentence; empty if `path` is no script, or its interpreter exists.
std::string interpreter_trouble(const std::string& path);

}  // namespace xr3
