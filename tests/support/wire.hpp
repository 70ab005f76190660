// The client's end of a serial line in memory (HTTP and TLS detector, telnet filter, endpoint)
// without a socket, so that tests can send bytes and read replies. Several lines may share a
// machine.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "tests/support/one_line.hpp"

namespace xr3::test {

class Wire {
 public:
  explicit Wire(ModelPtr model) : one_(std::move(model)) {}

  /// Sends bytes at the simulation's tick. Ignored if the line is closed. Precondition: it is a
  /// machine of the wire's robot.
  void send(std::string_view bytes, Simulation& simulation);
  /// The bytes received since the last call.
  std::string received() { return one_.fetch(); }
  /// The commands and problems of the bytes, in order.
  const std::vector<Exchange>& exchanges() const { return exchanges_; }
  /// The stable codes of all problems, in order.
  std::vector<std::string> problems() const;
  /// The line was closed because the client sent HTTP, TLS or STUN.
  bool is_closed() const { return one_.line.is_not_a_robot_program(); }

 private:
  OneLine one_;
  std::vector<Exchange> exchanges_;
};

}  // namespace xr3::test
