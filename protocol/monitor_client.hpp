// One client of the monitor without its connection: messages in, requests to carry out, and messages
// out: answers in a lane that is bounded by what the client has not taken yet, then what it follows.
// JSON lines over TCP, and others, are thin shells around it. It knows no cell.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/monitor_lines.hpp"
#include "protocol/monitor_message.hpp"
#include "protocol/monitor_request.hpp"
#include "protocol/monitor_subscription.hpp"

namespace xr3::monitor {

class Client {
 public:
  static constexpr std::size_t kMostAnswers = 256;
  static constexpr std::size_t kMostAnswerBytes = 256 * 1024;

  /// `cells` are those that a request may name, the default first.
  explicit Client(std::vector<std::string> cells) : cells_(std::move(cells)) {}
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Takes one message. A request is to be carried out, and answered by send(), before the next one
  /// is taken; a message that is none has been answered by its error.
  std::optional<Request> take(std::string_view message);

  /// Puts a message at the end of the lane. After end() nothing is taken any more.
  void send(Message message);
  /// Puts the messages begin <= seq < end of a ring into the lane, each with the id; those that have
  /// gone from the ring when their turn comes are told of by one `lag`.
  void replay(Feed& feed, const std::string& cell, const Get& get, const RequestId& id);
  /// Puts the last message at the end of the lane; what was followed ends.
  void end(Bye why);
  /// Ends because of what came as a line.
  void end(LineFault fault);
  bool has_ended() const { return farewell_.has_value(); }
  /// Why it has ended; nothing where it has not.
  std::optional<Bye> farewell() const { return farewell_; }

  /// No request may be taken until the client has taken some of its answers.
  bool is_full() const { return lane_.size() >= kMostAnswers || lane_bytes_ >= kMostAnswerBytes; }

  /// Follows a channel of a cell, in place of what was followed there.
  FrameSubscription& follow_frames(const std::string& cell, const Subscribe& wanted);
  void follow_feed(const std::string& cell, const Subscribe& wanted, Feed& feed);
  void unfollow(const std::string& cell, Channel channel);
  bool follows_anything() const { return !followed_.empty(); }

  /// Calls `visit(FrameSubscription&)` for each latest-wins channel that is followed.
  template <class Visit>
  void for_each_frame_subscription(const Visit& visit) {
    for (auto& [where, followed] : followed_) {
      if (auto* frames = std::get_if<FrameSubscription>(&followed)) visit(*frames);
    }
  }

  /// Calls `bring(object)` with what the next frame will touch first, which it may only take the address
  /// of.
  template <class Bring>
  void prefetch(const Bring& bring) const {
    if (follows_anything()) bring(*followed_.begin());
  }

  /// What it was given of each channel, by Channel.
  const std::array<Tally, kChannels>& tallies() const { return tallies_; }

  /// Something can go out now.
  bool has_output(FrameNumber now) const;
  /// The message that is to go out next, or null: answers first, then each channel in turn.
  Message next_output(FrameNumber now);

 private:
  using Followed = std::variant<FrameSubscription, FeedSubscription>;
  using Where = std::pair<std::string, Channel>;

  /// The rest of a `get` of a ring.
  struct Replay {
    FeedSubscription from;
    std::int64_t end;
    RequestId id;
  };

  Tally& tally_of(Channel channel) { return tallies_.at(static_cast<std::size_t>(channel)); }
  Message next_answer();
  Message next_followed(FrameNumber now);

  std::vector<std::string> cells_;
  std::deque<std::variant<Message, Replay>> lane_;
  std::size_t lane_bytes_ = 0;
  std::array<Tally, kChannels> tallies_{};
  std::map<Where, Followed> followed_;
  const Where* last_turn_ = nullptr;  ///< the key of the channel that had its turn last
  std::optional<Bye> farewell_;
};

}  // namespace xr3::monitor
