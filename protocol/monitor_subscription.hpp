// What a client follows: a channel of which the latest frame counts, in one slot, or one of which every
// message counts, by a cursor. Both tell of what the client was too slow for. They know no cell.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/monitor_feed.hpp"
#include "protocol/monitor_message.hpp"
#include "protocol/monitor_request.hpp"

namespace xr3::monitor {

/// Wall time on the grid of all frames: 1/60 s, counted from any moment.
using FrameNumber = std::int64_t;
inline constexpr int kFramesPerSecond = 60;

/// One message of a latest-wins channel, shared by all who selected the same.
struct Frame {
  Message message;
  std::int64_t seq = 0;
  /// What is compared to find a change: the members but for time. Shared as long as it is equal.
  std::shared_ptr<const std::string> content;
};

/// Messages of one channel that a client was given, and those that went past it.
struct Tally {
  std::uint64_t sent = 0;
  std::uint64_t overwritten = 0;
};

/// How often a change is looked for, however small max_hz is: it should be seen soon.
inline constexpr MilliHz kLookMilliHz = 10'000;

/// A latest-wins channel: one slot, filled by offer(), emptied when the client can take it.
class FrameSubscription {
 public:
  /// `tally` outlives it.
  FrameSubscription(std::string cell, const Subscribe& wanted, Tally& tally)
      : cell_(std::move(cell)), wanted_(wanted), tally_(&tally) {}

  const Subscribe& wanted() const { return wanted_; }

  /// The first frame at which it is worth while to look again: the next of max_hz's grid, or, where
  /// nothing had changed, the next of kLookMilliHz's if that comes sooner.
  FrameNumber due() const { return due_; }
  bool is_due(FrameNumber now) const { return now >= due_; }

  /// Puts a frame into the slot, unless on_change holds and nothing has changed.
  void offer(const Frame& frame, FrameNumber now);
  /// Something waits in the slot.
  bool is_waiting() const { return waiting_.message != nullptr; }

  /// The client has, or will have, what the content shows, and nothing is to be told of later.
  bool is_settled(const Frame& current) const;

  /// What goes out now, or null: first a `lag`, at most one a second, then the frame.
  Message next_output(FrameNumber now);
  bool has_output(FrameNumber now) const { return waiting_.message || is_lag_due(now); }

 private:
  bool is_lag_due(FrameNumber now) const;
  void miss_waiting();

  std::string cell_;
  Subscribe wanted_;
  Frame waiting_;
  std::shared_ptr<const std::string> sent_;  ///< content of the last frame that went out
  FrameNumber due_ = 0;
  FrameNumber last_lag_ = -kFramesPerSecond;
  Missed missed_;
  Tally* tally_;
};

/// A channel of which every message counts: a cursor into its ring.
class FeedSubscription {
 public:
  /// `feed` and `tally` outlive it. From `since` on, or only what comes from now on.
  FeedSubscription(std::string cell, const Subscribe& wanted, Feed& feed, Tally& tally);

  const Subscribe& wanted() const { return wanted_; }
  bool has_output() const { return next_ < feed_->next(); }
  /// The next message, or the `lag` where messages have gone from the ring, or null.
  Message next_output();
  /// The seq of the message that comes next.
  std::int64_t position() const { return next_; }

 private:
  std::string cell_;
  Subscribe wanted_;
  Feed* feed_;
  Tally* tally_;
  std::int64_t next_;
};

}  // namespace xr3::monitor
