// The Asio headers and names that the server uses, and its completion token: coroutines resume with
// (error, result) instead of an exception.
#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace xr3 {

namespace asio = boost::asio;
using asio::ip::tcp;
using ErrorCode = boost::system::error_code;

inline constexpr auto kAwait = asio::as_tuple(asio::use_awaitable);

}  // namespace xr3
