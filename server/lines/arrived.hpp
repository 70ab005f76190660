// The bytes of serial lines that have arrived and must act before a call. They are read in rounds,
// so that no line keeps the call from the bytes of another, and piece by piece, so that no other
// port waits for them.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "server/lines/session.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class ArrivedBytes {
 public:
  /// The bytes of a line in one round, and of all lines together: then the rounds end. Each line
  /// has one round at least.
  static constexpr std::size_t kRound = 2048;
  static constexpr std::size_t kMax = 2 * 1024 * 1024;

  /// `wake` is called for each line that has more to do after its last round.
  explicit ArrivedBytes(std::function<void(LineId)> wake) : wake_(std::move(wake)) {}

  void add(const std::shared_ptr<LineSession>& session) { lines_.push_back({session, {}}); }

  /// Reads until `end`, but one round of one line at least. Returns whether there is more to read.
  bool read(WallNs end);

 private:
  struct Line {
    std::weak_ptr<LineSession> session;
    std::optional<LineSession::Limits> limits;  ///< nullopt before its first round
  };

  void read_next();
  bool is_over(const LineSession& session, const LineSession::Limits& limits) const;
  /// Returns whether there is more to read of the line.
  bool read_round(LineSession& session, LineSession::Limits& limits);

  std::function<void(LineId)> wake_;
  std::deque<Line> lines_;
  std::size_t left_ = kMax;
};

}  // namespace xr3
