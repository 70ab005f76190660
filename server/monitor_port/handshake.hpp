// The server's side of a WebSocket handshake (Boost.Beast), whatever the connection carries then.
#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <string>
#include <string_view>

#include "server/http/wire.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

using Handshake = boost::beast::http::request<boost::beast::http::empty_body>;

inline Handshake parse_handshake(const std::string& head) {
  boost::beast::http::request_parser<boost::beast::http::empty_body> parser;
  parser.header_limit(2 * http::kMaxHeadBytes);  // never reached: our own limit was checked before
  ErrorCode error;
  parser.put(asio::buffer(head), error);
  return parser.release();
}

/// Accepts the handshake with this valid head, and names the subprotocol if the client has offered
/// any. Returns whether the connection is there then.
template <class Stream>
asio::awaitable<bool> accept_handshake(Stream& stream, const std::string& head,
                                       std::string_view subprotocol) {
  namespace ws = boost::beast::websocket;
  const Handshake handshake = parse_handshake(head);
  const bool has_offer = handshake.count("Sec-WebSocket-Protocol") > 0;
  stream.set_option(ws::stream_base::decorator([has_offer, subprotocol](ws::response_type& answer) {
    if (has_offer) answer.set("Sec-WebSocket-Protocol", subprotocol);
    answer.set(boost::beast::http::field::server, "xr3");  // default: Beast's name
    for (const http::Field& field : http::safety_fields()) answer.set(field.name, field.value);
  }));
  const auto [error] = co_await stream.async_accept(handshake, kAwait);
  co_return !error;
}

}  // namespace xr3
