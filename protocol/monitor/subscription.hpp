// The subscriptions of a client: to a latest-wins channel, with a slot for one frame, or to a
// channel without loss, with a cursor into its ring. Both report messages that a slow client has
// missed with `lag`. Independent of the cell.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/monitor/feed.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

/// Wall time in frames of 1/60 s, counted from an arbitrary moment.
using FrameNumber = std::int64_t;
inline constexpr int kFramesPerSecond = 60;

/// Identifies a content without keeping it: equal contents have equal ids, and different ones have
/// different ids except by a chance of 1 in 2^64.
struct ContentId {
  std::uint64_t hash = 0;
  std::size_t bytes = 0;  ///< 0: no content
  bool operator==(const ContentId&) const = default;
};
ContentId content_id(std::string_view content);

/// A message of a latest-wins channel, shared by all subscribers with the same selection.
struct Frame {
  Message message;
  std::int64_t seq = 0;
  ContentId content;  ///< content of the members without time, compared to detect changes
};

/// Statistics of a channel: messages sent to a client, and messages that it missed.
struct ChannelStats {
  std::uint64_t sent = 0;
  std::uint64_t overwritten = 0;
};

/// Minimum rate of checks for changes, however low max_hz is, so that a change is sent soon.
inline constexpr MilliHz kMinCheckMilliHz = 10'000;

/// A subscription to a latest-wins channel: one slot, filled by offer() and emptied when the client
/// can receive.
class FrameSubscription {
 public:
  /// `stats` must outlive it.
  FrameSubscription(std::string cell, const Subscribe& wanted, ChannelStats& stats)
      : cell_(std::move(cell)), wanted_(wanted), stats_(&stats) {}

  const Subscribe& wanted() const { return wanted_; }

  /// The frame from which offer() should be called again: the next slot of max_hz, or, if nothing
  /// had changed, the next slot of kMinCheckMilliHz if that is sooner.
  FrameNumber due() const { return due_; }
  bool is_due(FrameNumber now) const { return now >= due_; }

  /// Offers and sends no frame until release().
  void hold();
  /// Ends hold(): the next frame is sent even if nothing has changed.
  void release();

  /// Stores a frame in the slot, unless on_change is set and nothing has changed, or it is held.
  void offer(const Frame& frame, FrameNumber now);
  /// Whether the slot holds a frame.
  bool is_waiting() const { return waiting_.message != nullptr; }
  /// The bytes of the frame in the slot.
  std::size_t waiting_bytes() const { return is_waiting() ? waiting_.message->size() : 0; }

  /// Whether, with on_change, the client has or will receive this content, and no `lag` is pending.
  /// A held subscription is settled.
  bool is_settled(const Frame& current) const;

  /// The next message to send; nullptr if there is none. First a `lag` (at most one per second),
  /// then the frame.
  Message next_output(FrameNumber now);
  bool has_output(FrameNumber now) const { return waiting_.message || is_lag_due(now); }

 private:
  bool is_lag_due(FrameNumber now) const;
  void miss_waiting();

  std::string cell_;
  Subscribe wanted_;
  Frame waiting_;
  ContentId sent_;  ///< content of the last frame sent
  FrameNumber due_ = 0;
  bool is_held_ = false;
  FrameNumber last_lag_ = -kFramesPerSecond;
  Missed missed_;
  ChannelStats* stats_;
};

/// The subscription of a client to `overview`: one slot. A message in it shows all changes since
/// the one sent before, so the next one is made when the slot is empty.
class OverviewSubscription {
 public:
  /// `stats` must outlive it.
  OverviewSubscription(MilliHz max_millihz, ChannelStats& stats)
      : max_millihz_(max_millihz), stats_(&stats) {}

  /// The seq of the last message offered; 0 if there was none.
  std::int64_t seen() const { return seen_; }
  bool is_waiting() const { return waiting_ != nullptr; }
  std::size_t waiting_bytes() const { return waiting_ ? waiting_->size() : 0; }
  bool is_due(FrameNumber now) const { return now >= due_; }
  /// Makes the next message show all cells.
  void restart() {
    seen_ = 0;
    waiting_.reset();
  }
  /// Stores a message in the slot. Precondition: !is_waiting().
  void offer(Message message, std::int64_t seq, FrameNumber now);
  /// The message in the slot, or nullptr.
  Message next_output();

 private:
  MilliHz max_millihz_;
  ChannelStats* stats_;
  Message waiting_;
  std::int64_t seen_ = 0;
  FrameNumber due_ = 0;
};

/// A subscription to a channel without loss: a cursor into its ring. When the ring is destroyed,
/// with its cell, it has no further message.
class FeedSubscription {
 public:
  /// `stats` must outlive it. Starts at `since`, or at the next message.
  FeedSubscription(std::string cell, const Subscribe& wanted, const std::shared_ptr<Feed>& feed,
                   ChannelStats& stats);

  const Subscribe& wanted() const { return wanted_; }
  bool has_output() const {
    const std::shared_ptr<Feed> feed = feed_.lock();
    return feed && next_ < feed->next();
  }
  /// The next message, or a `lag` if messages have been overwritten in the ring, or nullptr.
  Message next_output();
  /// If more than `most` messages wait, counts all but the last as overwritten.
  void skip_to_last(std::int64_t most);
  /// The seq of the next message.
  std::int64_t position() const { return next_; }

 private:
  std::string cell_;
  Subscribe wanted_;
  std::weak_ptr<Feed> feed_;
  ChannelStats* stats_;
  std::int64_t next_;
  std::int64_t skipped_to_ = 0;  ///< seq before which messages are not sent
};

}  // namespace xr3::monitor
