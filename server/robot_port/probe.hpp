// Asks whether the robot port serves lines, down a real one: a TCP connection from this process to its own
// robot port, an inquiry, and the one byte that answers it. Accepting, waiting, reading, the cell and
// writing all have their part in the answer; nothing of it is counted, told or recorded.
#pragma once

#include <chrono>
#include <string>

#include "server/net/asio.hpp"
#include "server/robot_port/port.hpp"

namespace xr3 {

class RobotProbe {
 public:
  /// For so long an answer is waited for.
  static constexpr std::chrono::milliseconds kPatience{500};
  /// For so long an outcome holds: a flood of questions costs ten probes a second.
  static constexpr std::chrono::milliseconds kFresh{100};

  /// The port outlives it. It listens where it is asked.
  RobotProbe(asio::io_context& io, RobotPort& port);

  /// Nothing where lines are served; otherwise why not, as a sentence. One probe is under way at a time,
  /// and all who ask meanwhile get its outcome.
  asio::awaitable<std::string> trouble();

 private:
  class Asking;
  struct Reply;

  asio::awaitable<std::string> ask();
  asio::awaitable<Reply> exchange(tcp::socket& socket);
  std::string verdict(const Reply& reply) const;

  asio::io_context& io_;
  RobotPort& port_;
  bool is_asking_ = false;
  asio::steady_timer answered_;  ///< never expires; cancelled when a probe is done
  std::string trouble_;          ///< of the last probe
  std::chrono::steady_clock::time_point fresh_until_;
};

}  // namespace xr3
