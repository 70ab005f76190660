// Starts every coroutine that nobody awaits, so that no exception is lost: a loop's exception ends the
// process, a session's exception ends its connection. (co_spawn with `detached` swallows both.)
#pragma once

#include <functional>

#include "server/net/asio.hpp"

namespace xr3 {

/// Starts a loop that the process needs. An exception out of it leaves the run() of its context as a
/// VitalFailure that begins with `name`. The name is a literal.
void spawn_loop(const asio::any_io_executor& executor, const char* name,
                asio::awaitable<void> loop);

/// Starts what serves one connection; calls `ended` when it has returned or failed. A failure is logged
/// with the name, and ends nothing else; a VitalFailure leaves run() as that of a loop does.
void spawn_session(const asio::any_io_executor& executor, const char* name,
                   asio::awaitable<void> session, std::function<void()> ended);

}  // namespace xr3
