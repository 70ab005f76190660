// The end of a recording: a cell without lines, as it was when the recording ended, also when its
// server was killed. It is made piece by piece, for a thread that has other work.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cell/cell.hpp"
#include "cell/recording/replayer.hpp"
#include "protocol/monitor/byte_budget.hpp"
#include "server/net/wall_clock.hpp"
#include "server/recording/source.hpp"

namespace xr3 {

class RecordedEnd {
 public:
  /// The time of work after which a recording is given up.
  static constexpr WallNs kMostWork = 300'000'000'000;
  /// Memory for events and records of lines, of which nothing is kept.
  static constexpr std::size_t kRingBytes = std::size_t{64} * 1024;

  explicit RecordedEnd(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  /// Works for about this time. Returns whether the end is reached, or never will be. Never throws.
  /// For any thread, but one at a time.
  bool work(WallNs time);

  /// After work() has returned true: why there is no end; empty if there is one.
  const std::string& why() const { return why_; }
  /// The end, as the first line of a recording that goes on from it. Precondition: why() is empty.
  recording::Header header() const;

 private:
  void open();
  bool apply(WallNs until);
  void close_lines();

  std::string path_;
  std::optional<RecordingSource> source_;
  monitor::ByteBudget rings_{kRingBytes};
  std::unique_ptr<Cell> cell_;
  std::optional<Replayer> replayer_;
  WallNs worked_ = 0;
  std::string origin_;
  std::string why_;
};

}  // namespace xr3
