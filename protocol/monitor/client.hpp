// A client of the monitor port, without its transport: messages in, requests to execute, and
// messages out. Transports (JSON lines over TCP, WebSocket) only move bytes. Independent of the
// cell.
//
// The flow through the folder: a transport splits the bytes into messages (protocol_detector.hpp,
// line_splitter.hpp); for WebSocket http_guard.hpp checks Host and Origin. heading.hpp finds op and
// fn for the access check without parsing. Client::handle() parses the message with request.hpp,
// whose calls are in call_table.hpp and calls/ (arguments.hpp reads their members, call.hpp has
// their values), and returns the request; the server executes it on a cell and answers with send(),
// in the forms of message.hpp. Subscriptions (subscription.hpp) follow the replies: latest-wins
// channels have one slot for a frame, channels without loss a cursor into a ring (feed.hpp), whose
// memory all cells share (byte_budget.hpp). snapshot.hpp, image.hpp, display.hpp, model.hpp,
// event.hpp and overview.hpp write the members of the channels. saved_cell.hpp converts snapshots.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/subscription.hpp"

namespace xr3::monitor {

class Client {
 public:
  static constexpr std::size_t kMaxAnswers = 256;
  static constexpr std::size_t kMaxAnswerBytes = 256 * 1024;

  Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Handles one message. The caller must execute the returned request and answer it with send()
  /// before the next message. For an invalid message it queues an error and returns nullopt.
  std::optional<Request> handle(std::string_view message);
  /// Handles a message that read_request() has read, like handle().
  std::optional<Request> accept(RequestReading reading);

  /// Appends a message to the reply queue. Ignored after end().
  void send(Message message);
  /// Queues the messages that a `get` asks for from a ring, each with the id. One `lag` reports
  /// those that have been overwritten by the time they are sent.
  void replay(const std::shared_ptr<Feed>& feed, const std::string& cell, const Get& get,
              const RequestId& id);
  /// Appends `bye` to the reply queue and ends all subscriptions.
  void end(CloseReason why);
  /// Ends because of an invalid line.
  void end(LineFault fault);
  bool has_ended() const { return close_reason_.has_value(); }
  /// The reason of end(); nullopt before.
  std::optional<CloseReason> close_reason() const { return close_reason_; }

  /// Whether the reply queue is full: handle no request until the client has read some replies.
  bool is_full() const {
    return reply_queue_.size() >= kMaxAnswers || reply_queue_bytes_ >= kMaxAnswerBytes;
  }

  /// The bytes of the replies in the queue and of the frames in the slots.
  std::size_t held_bytes() const;

  /// Subscribes to a channel of a cell; replaces an earlier subscription to it.
  FrameSubscription& follow_frames(const std::string& cell, const Subscribe& wanted);
  void follow_feed(const std::string& cell, const Subscribe& wanted,
                   const std::shared_ptr<Feed>& feed);
  void unfollow(const std::string& cell, Channel channel);
  /// Ends all subscriptions to a cell that closes. Of each channel without loss, the messages that
  /// are not sent yet go to the reply queue: all if they are few, else a `lag` and the last one.
  void finish(const std::string& cell);
  /// Sends no frame of the cell, also of later subscriptions, until release_frames(): the client
  /// views the past. Messages of channels without loss continue.
  void hold_frames(const std::string& cell);
  /// Ends hold_frames().
  void release_frames(const std::string& cell);
  bool holds_frames(const std::string& cell) const { return held_.contains(cell); }

  bool follows_anything() const { return !followed_.empty() || overview_; }
  /// The number of subscriptions to channels of cells.
  std::size_t subscriptions() const { return followed_.size(); }
  bool follows(const std::string& cell) const;
  bool follows(const std::string& cell, Channel channel) const {
    return followed_.contains({cell, channel});
  }

  /// Calls `visit(FrameSubscription&)` for each subscription to a latest-wins channel of the cell.
  template <class Visit>
  void for_each_frame_subscription(const std::string& cell, const Visit& visit) {
    for (auto each = followed_.lower_bound({cell, Channel::kState});
         each != followed_.end() && each->first.first == cell; ++each) {
      if (auto* frames = std::get_if<FrameSubscription>(&each->second)) visit(*frames);
    }
  }

  /// Subscribes to the overview of all cells; replaces an earlier subscription to it.
  void follow_overview(MilliHz max_millihz) {
    overview_.emplace(max_millihz, stats_of(Channel::kOverview));
  }
  void unfollow_overview() { overview_.reset(); }
  /// The subscription to the overview; nullptr if not subscribed.
  OverviewSubscription* overview() { return overview_ ? &*overview_ : nullptr; }

  /// Statistics per channel, indexed by Channel.
  const std::array<ChannelStats, kChannels>& channel_stats() const { return channel_stats_; }

  /// Whether next_output() has a message.
  bool has_output(FrameNumber now) const;
  /// The next message to send; nullptr if there is none. Replies first, then the subscriptions,
  /// round-robin.
  Message next_output(FrameNumber now);

 private:
  using Followed = std::variant<FrameSubscription, FeedSubscription>;
  using Where = std::pair<std::string, Channel>;

  /// The remaining messages of a `get` from a ring.
  struct Replay {
    FeedSubscription from;
    std::int64_t end;
    RequestId id;
  };

  ChannelStats& stats_of(Channel channel) {
    return channel_stats_.at(static_cast<std::size_t>(channel));
  }
  Message next_answer();
  Message next_followed(FrameNumber now);

  std::deque<std::variant<Message, Replay>> reply_queue_;
  std::size_t reply_queue_bytes_ = 0;
  std::array<ChannelStats, kChannels> channel_stats_{};
  std::map<Where, Followed> followed_;
  std::set<std::string> held_;  ///< names of cells whose frames are held
  std::optional<OverviewSubscription> overview_;
  const Where* last_turn_ = nullptr;  ///< the key of the channel that was served last
  std::optional<CloseReason> close_reason_;
};

}  // namespace xr3::monitor
