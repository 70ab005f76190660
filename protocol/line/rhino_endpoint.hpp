// The controller's end of a serial line: bytes in, replies out, and a record of how each byte was
// interpreted. It holds the parser of one line; the machine is shared with the other lines.
//
// The flow through the folder: on a new connection line_guard.hpp and http_tls_detector.hpp examine
// the first bytes and refuse browsers. telnet.hpp then removes telnet commands and answers them
// (parser, options and the COM-PORT of RFC 2217 are in telnet_parser.hpp, telnet_options.hpp and
// com_port.hpp); a raw client passes unchanged. RhinoEndpoint::parse() passes each data byte to
// rhino_parser.hpp, which emits a command at its last byte, or a problem. execute() executes the
// command on the Simulation of core and encodes the reply with rhino_reply.hpp, which telnet.hpp
// escapes.
// line_speed.hpp says how long the bytes take at a baud rate. With a physical controller
// device_command.hpp encodes the commands for it instead. telnet_client.hpp is the other end, for
// `xr3 term`. All of these are values without I/O.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/line/rhino_parser.hpp"

namespace xr3 {

/// A command with its reply and its immediate events, or a problem.
struct Exchange {
  explicit Exchange(Parsed item) : parsed(std::move(item)) {}

  Parsed parsed;
  Reply reply;
  Events events;
  bool is_for_device = false;  ///< true if not executed: it goes to the physical controller
};

class RhinoEndpoint {
 public:
  explicit RhinoEndpoint(Profile profile) : profile_(profile), parser_(profile) {}

  /// Parses the byte at `offset` of the line's input: returns the items that it completes, in
  /// order, at most three. Valid until the next call. `enabled`: whether the simulator is.
  const std::vector<Parsed>& parse(std::uint8_t byte, std::uint64_t offset, bool enabled);
  /// Executes one of these items at the simulation's tick. Appends the reply to `replies`, and an
  /// entry for the command or problem to `exchanges`. Precondition: the simulation has no pending
  /// events; those of the command are moved into its entry.
  void execute(const Parsed& item, Simulation& simulation, std::string& replies,
               std::vector<Exchange>& exchanges) const;

  /// Discards an incomplete command.
  void reset() { parser_ = RhinoParser(profile_); }

  const RhinoParser& parser() const { return parser_; }

  /// Whether they interpret the next bytes alike.
  bool operator==(const RhinoEndpoint& other) const {
    return profile_ == other.profile_ && parser_ == other.parser_;
  }

 private:
  Profile profile_;
  RhinoParser parser_;
  std::vector<Parsed> parsed_;  ///< a member only to reuse its memory
};

}  // namespace xr3
