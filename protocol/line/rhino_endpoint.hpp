// The controller's end of a serial line: bytes in, replies out, and a record of how each byte was
// interpreted. It holds the parser of one line; the machine is shared with the other lines.
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
  /// The reply's bytes [from, to) in the line's output. Set by the caller when it sends the reply;
  /// equal if there is no reply.
  std::uint64_t reply_from = 0;
  std::uint64_t reply_to = 0;
  bool is_for_device = false;  ///< not executed: it goes to the physical controller
};

class RhinoEndpoint {
 public:
  explicit RhinoEndpoint(Profile profile) : profile_(profile), parser_(profile) {}

  /// Handles the byte at `offset` of the line's input at the simulation's tick. Appends replies to
  /// `replies` and an entry for each command or problem to `exchanges`. Precondition: the
  /// simulation has no pending events; those of the command are moved into its entry.
  void feed(std::uint8_t byte, std::uint64_t offset, Simulation& simulation, std::string& replies,
            std::vector<Exchange>& exchanges);

  /// The first half of feed(): what the byte completes, in order, at most three items. Valid until
  /// the next call. `enabled`: the simulator is.
  const std::vector<Parsed>& parse(std::uint8_t byte, std::uint64_t offset, bool enabled);
  /// The second half of feed(), for one of these items.
  void execute(const Parsed& item, Simulation& simulation, std::string& replies,
               std::vector<Exchange>& exchanges) const;

  /// Discards an incomplete command.
  void reset() { parser_ = RhinoParser(profile_); }

  const RhinoParser& parser() const { return parser_; }

 private:
  Profile profile_;
  RhinoParser parser_;
  std::vector<Parsed> parsed_;  ///< a member only to reuse its memory
};

}  // namespace xr3
