// Checks whether the robot port serves lines, with a real TCP connection from this process to its
// own robot port: an inquiry, and the reply of one byte. This covers accepting, waiting, reading,
// the cell and writing. The probe is not counted, recorded or reported.
#pragma once

#include <chrono>
#include <string>

#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/robot_port/port.hpp"

namespace xr3 {

class RobotProbe {
 public:
  /// Maximum time for the reply.
  static constexpr std::chrono::milliseconds kPatience{500};
  /// A result is reused for this time, so that a flood of requests costs at most ten probes a
  /// second.
  static constexpr std::chrono::milliseconds kFresh{100};

  /// `port` must outlive the probe. Precondition of trouble(): the port is listening.
  RobotProbe(asio::io_context& io, RobotPort& port) : io_(io), port_(port), asking_(io) {}

  /// Empty if lines are served; otherwise the reason, as a sentence. Only one probe runs at a time;
  /// all callers in that time get its result.
  asio::awaitable<std::string> trouble();

  /// As trouble(), but empty if every line is in use: the port has said so itself, so it works.
  asio::awaitable<std::string> failure();

 private:
  struct Reply;

  asio::awaitable<std::string> ask();
  asio::awaitable<Reply> exchange(tcp::socket& socket);
  std::string verdict(const Reply& reply);

  asio::io_context& io_;
  RobotPort& port_;
  Exclusive asking_;      ///< held by the probe that runs
  std::string trouble_;   ///< of the last probe
  bool is_full_ = false;  ///< it found every line in use
  std::chrono::steady_clock::time_point fresh_until_;
};

}  // namespace xr3
