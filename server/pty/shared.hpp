// The state that the thread of a pseudo-terminal and the event loop share. All else has one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>

#include "server/files/descriptor.hpp"
#include "server/pty/pseudo_terminal.hpp"

namespace xr3 {

/// The maximum number of bytes that a round of the thread moves.
inline constexpr std::size_t kPtyRound = 4096;

struct PtyShared {
  /// The settings of the program's bytes from this offset in the line on.
  struct Change {
    std::uint64_t offset;
    PtyModes modes;
  };

  std::mutex use;  ///< held to read or write the other members
  /// The event loop's end of the socket pair of a program that has arrived, until it is accepted.
  Descriptor line;
  /// The changes that the event loop has not reached, by offset. A change is added before the byte
  /// at its offset is written to the socket pair.
  std::deque<Change> changes;
  std::exception_ptr failure;      ///< the reason why programs are not served; nullptr if they are
  std::uint64_t rounds_ended = 0;  ///< PtyPump::begin_round()
  bool is_closing = false;
};

}  // namespace xr3
