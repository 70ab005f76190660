// The processes that a program under test leaves behind. This process adopts them all, so that none
// outlives the run.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace xr3 {

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
