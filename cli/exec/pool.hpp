// Runs independent tasks in child processes, several at a time, so that one that fails does not
// affect others.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/exec/stop_signals.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

/// Runs tasks 0...count-1, each in a process of its own, at most `jobs` at a time, and returns
/// their results in order; nullopt for a process that failed, or had not ended `limit` after its
/// start and was killed (0 for no limit). `done` is called in this process after each. SIGINT and
/// SIGTERM end this process and with it all of them; with `stop` they end the tasks in progress,
/// which return nullopt, without `done`. Precondition: this process has one thread. Throws
/// std::system_error if a process cannot be made.
std::vector<std::optional<std::string>> in_processes(
    std::size_t count, std::size_t jobs, WallNs limit,
    const std::function<std::string(std::size_t)>& task,
    const std::function<void(std::size_t)>& done, StopSignals* stop = nullptr);

}  // namespace xr3
