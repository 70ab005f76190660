// The processes that a program under test leaves behind. This process adopts them all, so that none
// outlives the run.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <istream>
#include <vector>

namespace xr3 {

/// The parent of a process by its file `/proc/PID/stat`, or 0 if the process has ended, also if it
/// ends while the file is read: then reading fails.
::pid_t parent_in(std::istream& stat);

/// From now on, orphaned descendants become children of this process. Throws std::system_error.
void adopt_orphans();

/// The children of this process.
std::vector<::pid_t> children();

/// The number of processes that descend from this one.
std::size_t count_descendants();

/// Sends a signal to every descendant.
void signal_descendants(int signal);

/// Collects the exit codes of children that have ended, except `kept`.
void reap_children(::pid_t kept);

}  // namespace xr3
