// A client over a real socket in the server's thread. Waiting for bytes runs the server meanwhile,
// up to a deadline.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "protocol/json/source.hpp"
#include "server/net/asio.hpp"

namespace xr3::test {

class Client {
 public:
  Client(asio::io_context& io, const tcp::endpoint& server);

  /// Sends all bytes; the server does not run meanwhile.
  void send(std::string_view bytes);
  void half_close() { socket_.shutdown(tcp::socket::shutdown_send); }

  /// Receives `count` bytes; fewer at the end of the connection or at the deadline.
  std::string bytes(std::size_t count);
  /// Receives a line; less at the end of the connection.
  std::string line();
  Json json() { return Json::parse(line()); }
  /// Receives everything up to the end of the connection.
  std::string rest();

 private:
  bool read();

  asio::io_context& io_;
  tcp::socket socket_;
  std::string received_;
};

}  // namespace xr3::test
