// One Foxglove client of a cell: its subscriptions, the topics that are due, and the answers to its
// requests.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/foxglove/wire.hpp"
#include "server/foxglove/feed.hpp"
#include "server/session/websocket_session.hpp"

namespace xr3 {

class FoxgloveSession final : public WebsocketSession {
 public:
  /// Sends `serverInfo` and `advertise`. The sink must outlive the session. `run` differs between
  /// runs of the server.
  FoxgloveSession(MessageSink& sink, std::shared_ptr<FoxgloveFeed> feed, std::string_view run);
  FoxgloveSession(const FoxgloveSession&) = delete;
  FoxgloveSession& operator=(const FoxgloveSession&) = delete;
  ~FoxgloveSession() override { feed_->remove(*this); }

  asio::awaitable<void> handle(std::string_view message) override;
  std::optional<WebsocketMessage> next_output() override;
  bool is_full() const override { return answers_.size() >= kMaxAnswers; }
  std::size_t held_bytes() const override { return answer_bytes_; }
  void end(monitor::CloseReason why) override;
  std::optional<monitor::CloseReason> close_reason() const override { return close_reason_; }

  bool follows(foxglove::Topic topic) const { return subscriptions_.find(topic).has_value(); }
  /// These topics have a new message, and time has passed.
  void offer(const TopicSet& changed);

 private:
  static constexpr std::size_t kMaxAnswers = 64;

  void answer(std::string text);
  void begin(foxglove::Topic topic);
  std::optional<WebsocketMessage> next_answer();
  std::optional<WebsocketMessage> next_due();
  std::optional<WebsocketMessage> next_event();

  MessageSink& sink_;
  std::shared_ptr<FoxgloveFeed> feed_;
  foxglove::Subscriptions subscriptions_;
  std::deque<monitor::Message> answers_;
  std::size_t answer_bytes_ = 0;
  std::optional<foxglove::Nanoseconds> time_;  ///< the last one that was sent
  TopicSet due_;
  std::int64_t next_event_ = 0;  ///< if it follows events
  std::optional<monitor::CloseReason> close_reason_;
};

}  // namespace xr3
