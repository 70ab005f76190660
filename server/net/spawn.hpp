// Starts coroutines that are not awaited, without losing exceptions: an exception of a loop ends
// the process, one of a session ends its connection. (co_spawn with `detached` discards both.)
#pragma once

#include <functional>

#include "server/net/asio.hpp"

namespace xr3 {

/// Starts a loop that the process needs. An exception from it leaves io_context::run() as a
/// FatalFailure whose text begins with `name`, a string literal.
void spawn_loop(const asio::any_io_executor& executor, const char* name,
                asio::awaitable<void> loop);

/// Starts a coroutine that serves one connection; calls `ended` when it has returned or failed. A
/// failure is logged with the name and ends nothing else, except that a FatalFailure leaves
/// io_context::run().
void spawn_session(const asio::any_io_executor& executor, const char* name,
                   asio::awaitable<void> session, std::function<void()> ended);

}  // namespace xr3
