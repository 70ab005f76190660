// A client's end of a serial line in memory: the server's own Line (guard, telnet filter, endpoint)
// with no socket, so that a test says what a client sends and reads what it would get.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "server/line.hpp"

namespace xr3::test {

class Wire {
 public:
  explicit Wire(Profile profile) : line_(profile, LineKind::kRaw, "test", 0) {}

  /// What a client sends, at the simulation's tick; a closed line takes nothing.
  void send(std::string_view bytes, Simulation& simulation);
  /// What the client has received since the last call.
  std::string received();
  /// What was made of the bytes, in order.
  const std::vector<Exchange>& exchanges() const { return exchanges_; }
  /// The stable codes of all problems, in order.
  std::vector<std::string> problems() const;
  /// The client turned out to be a stranger.
  bool is_closed() const { return line_.is_stranger(); }

 private:
  Line line_;
  std::vector<Exchange> exchanges_;
};

}  // namespace xr3::test
