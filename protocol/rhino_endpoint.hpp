// The serial line's end at the controller: bytes in, replies out, and an account of what was made of
// each byte. It holds the parser of one line; the machine is shared with the other lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/rhino_parser.hpp"

namespace xr3 {

/// One command or problem, what the machine answered and what it had to tell at once.
struct Exchange {
  Parsed parsed;
  Reply reply;
  Events events;
  /// The reply's bytes [from, to) in the line's output; equal where there are none, or until whoever
  /// delivers them says so.
  std::uint64_t reply_from = 0;
  std::uint64_t reply_to = 0;
};

class RhinoEndpoint {
 public:
  explicit RhinoEndpoint(Profile profile) : profile_(profile), parser_(profile) {}

  /// Takes the byte at `offset` of the line's input at the simulation's tick. Replies are appended to
  /// `replies`, one entry for each command or problem to `exchanges`. The simulation's events must
  /// have been taken before: those of the command are taken here.
  void take(std::uint8_t byte, std::uint64_t offset, Simulation& simulation, std::string& replies,
            std::vector<Exchange>& exchanges);

  /// Forgets whatever has begun.
  void reset() { parser_ = RhinoParser(profile_); }

  const RhinoParser& parser() const { return parser_; }

 private:
  Profile profile_;
  RhinoParser parser_;
  std::vector<Parsed> parsed_;  ///< kept for its memory only
};

}  // namespace xr3
