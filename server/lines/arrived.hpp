// A read barrier: the bytes of serial lines that have arrived before a call are executed before it.
// The lines have ordinary turns, one after the other, until each has executed as many bytes as
// had arrived at the call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>

#include "server/lines/session.hpp"
#include "server/lines/turns.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class ArrivedBytes {
 public:
  /// Bounds for each line, for one that sends without end. Bytes beyond them are executed in later
  /// turns of the line, after the call.
  static constexpr std::size_t kMaxBytes = 128 * 1024;
  static constexpr std::size_t kMaxReplies = 1024 * 1024;  ///< bytes
  /// After this number of bytes of one line, the system is asked again: the rest of a burst that is
  /// larger than the receive buffer arrives while the beginning is read.
  static constexpr std::size_t kBurst = 2048;

  /// `turns` must outlive the barrier.
  explicit ArrivedBytes(LineTurns& turns) : turns_(turns) {}

  /// Adds the bytes of a line that have arrived now. Each line gets one turn at least: it may have
  /// ended, or hold bytes that it has read before. No effect if the session is closed.
  void add(SessionNumber number, const std::shared_ptr<LineSession>& session);

  /// Runs turns until `end`, but one at least. Returns whether there is more to read.
  bool read(WallNs end);

 private:
  struct Line {
    SessionNumber number;
    std::weak_ptr<LineSession> session;
    std::uint64_t start;        ///< LineSession::bytes_in() at the call
    std::uint64_t end;          ///< as start
    std::uint64_t last_end;     ///< as start: the bound for `end`
    std::uint64_t replies_end;  ///< LineSession::output_end()
  };

  bool run_turn(Line& line);
  static bool has_more(Line& line, const LineSession& session);

  LineTurns& turns_;
  std::deque<Line> lines_;
};

}  // namespace xr3
