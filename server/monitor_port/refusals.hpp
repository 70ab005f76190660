// Connections beyond the limit of the monitor port: each receives an error in its protocol and is
// closed. Independent of the cell.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <set>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"

namespace xr3 {

class Refusals {
 public:
  /// Maximum number at once; further connections are closed without an error.
  static constexpr std::size_t kMax = 64;

  /// `ended` is called when a refused connection has ended.
  explicit Refusals(std::function<void()> ended) : ended_(std::move(ended)) {}

  /// Waits up to 1 s for the first bytes, then sends status 503 to HTTP, nothing to TLS, and `bye`
  /// otherwise.
  void add(tcp::socket socket);
  /// Closes them all.
  void abort();
  bool is_empty() const { return sockets_.empty(); }

 private:
  std::function<void()> ended_;
  std::set<std::shared_ptr<MonitorSocket>> sockets_;
};

}  // namespace xr3
