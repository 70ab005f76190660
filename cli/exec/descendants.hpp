// The processes that a program under test leaves behind. This process adopts them all, so that none
// outlives the run.
#pragma once

#include <sys/types.h>

#include <istream>
#include <vector>

#include "server/net/wall_clock.hpp"

namespace xr3 {

/// The parent of a process by its file `/proc/PID/stat`, or 0 if the process has ended, also if it
/// ends while the file is read: then reading fails.
::pid_t parent_in(std::istream& stat);

/// Makes this process adopt its orphaned descendants. Throws std::system_error.
void adopt_orphans();

/// The processes that descend from this one, parents first.
std::vector<::pid_t> descendants();

/// Maximum time to end the processes that a program has left behind.
inline constexpr WallNs kKillLimit = 10'000'000'000;

/// Ends the children of this process, and their children, which this process then adopts, until it
/// has twice found no child: a process may start another one during the search. Gives up at the
/// deadline, in wall time. `kept` is ended, too, but stays for its owner to reap; 0 if there is
/// none.
void end_children(WallNs deadline, ::pid_t kept);

/// Collects the exit codes of children that have ended, except `kept`.
void reap_children(::pid_t kept);

}  // namespace xr3
