// The client's end of a serial line in memory: the cell's SerialLine (HTTP and TLS detector, telnet
// filter, endpoint) without a socket, so that tests can send bytes and read replies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cell/serial_line.hpp"
#include "core/simulation.hpp"

namespace xr3::test {

class Wire {
 public:
  explicit Wire(Profile profile) : line_(profile, LineKind::kTcp, "test", 0) {}

  /// Sends bytes at the simulation's tick. Ignored if the line is closed.
  void send(std::string_view bytes, Simulation& simulation);
  /// The bytes received since the last call.
  std::string received();
  /// The commands and problems of the bytes, in order.
  const std::vector<Exchange>& exchanges() const { return exchanges_; }
  /// The stable codes of all problems, in order.
  std::vector<std::string> problems() const;
  /// The line was closed because the client sent HTTP, TLS or STUN.
  bool is_closed() const { return line_.is_not_a_robot_program(); }

 private:
  SerialLine line_;
  std::vector<Exchange> exchanges_;
};

}  // namespace xr3::test
