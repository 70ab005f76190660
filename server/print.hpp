// Text for users on the standard streams. All commands print with these functions, since names in
// files and of files may contain anything: control characters are escaped, see
// protocol/text/printable.hpp. Exceptions: the log, which has its own sink; `xr3 term`, which moves
// the cursor and passes on bytes of the robot; and the output of a program under `xr3 exec`.
#pragma once

#include <string_view>

namespace xr3 {

/// Prints lines to standard output, at once.
void print_text(std::string_view lines);

/// Prints JSON to standard output, at once; its values stay the same.
void print_json(std::string_view json);

/// Prints lines to standard error.
void print_error(std::string_view lines);

}  // namespace xr3
