// Replaces the server's log: nothing is printed, and the first message of a failure is kept.
#pragma once

#include <string>

namespace xr3::seeds {

/// Once in a process. All messages from level info up are formatted.
void replace_log();

/// The first message since the last call that a session or the server has failed; empty: none.
std::string take_logged_failure();

}  // namespace xr3::seeds
