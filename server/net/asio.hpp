// The Asio headers and names that the server uses, its completion token, with which coroutines
// resume with (error, result) instead of an exception, and timers that call a function.
#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

#include "server/net/wall_clock.hpp"

namespace xr3 {

namespace asio = boost::asio;
using asio::ip::tcp;
using ErrorCode = boost::system::error_code;

inline constexpr auto kAwait = asio::as_tuple(asio::use_awaitable);

/// An event loop of one thread. shutdown() destroys waiting handlers and coroutines; the objects
/// that they refer to must still exist.
class EventLoop : public asio::io_context {
 public:
  EventLoop() : asio::io_context(1) {}
  using asio::io_context::shutdown;
};

/// Calls `act` when the timer expires, unless it is cancelled or set again before.
template <class Act>
void when_expired(asio::steady_timer& timer, Act act) {
  timer.async_wait([act = std::move(act)](ErrorCode cancelled) {
    if (!cancelled) act();
  });
}

/// Calls `act` at a wall time, to which the timer is set, unless it is cancelled or set again
/// before.
template <class Act>
void run_at(asio::steady_timer& timer, WallNs moment, Act act) {
  timer.expires_at(as_time_point(moment));
  when_expired(timer, std::move(act));
}

/// Calls `act` after this time, unless the timer is cancelled or set again before.
template <class Act>
void run_after(asio::steady_timer& timer, asio::steady_timer::duration time, Act act) {
  timer.expires_after(time);
  when_expired(timer, std::move(act));
}

}  // namespace xr3
