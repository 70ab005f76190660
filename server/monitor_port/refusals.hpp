// Connections beyond the limit of the monitor port: each is told that it is full in the language that it
// speaks, and closed. It knows no cell.
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
  /// That many are listened to at once; those beyond are closed without a word.
  static constexpr std::size_t kMax = 64;

  /// `ended` is called when one has been told.
  explicit Refusals(std::function<void()> ended) : ended_(std::move(ended)) {}

  /// Waits up to a second for its first bytes: HTTP gets a 503, all else `bye`.
  void add(tcp::socket socket);
  /// Closes them all.
  void abort();
  bool is_empty() const { return sockets_.empty(); }

 private:
  std::function<void()> ended_;
  std::set<std::shared_ptr<MonitorSocket>> sockets_;
};

}  // namespace xr3
