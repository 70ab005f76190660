// A client over a real socket in the same thread as the server: whoever waits for bytes lets the server
// run meanwhile, to a deadline.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/json_source.hpp"
#include "server/asio.hpp"

namespace xr3::test {

class Client {
 public:
  Client(asio::io_context& io, const tcp::endpoint& server);

  /// All of it; the server does not run meanwhile.
  void send(std::string_view bytes);
  /// As much as the connection takes, and how much that was.
  std::size_t send_some(std::string_view bytes);
  void half_close() { socket_.shutdown(tcp::socket::shutdown_send); }

  /// So many bytes, or what came before the connection ended or the deadline.
  std::string bytes(std::size_t count);
  /// The next line, or what came before the connection ended.
  std::string line();
  Json json() { return Json::parse(line()); }
  /// Everything up to the end of the connection.
  std::string rest();

 private:
  bool read();

  asio::io_context& io_;
  tcp::socket socket_;
  std::string received_;
};

}  // namespace xr3::test
