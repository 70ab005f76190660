#include "server/foxglove/session.hpp"

#include <algorithm>
#include <utility>

namespace xr3 {
namespace {

using foxglove::StatusLevel;
using foxglove::Topic;

std::size_t index_of(Topic topic) { return static_cast<std::size_t>(topic); }

}  // namespace

FoxgloveSession::FoxgloveSession(MessageSink& sink, std::shared_ptr<FoxgloveFeed> feed,
                                 std::string_view run)
    : sink_(sink), feed_(std::move(feed)) {
  answer(foxglove::server_info_text("xr3 " + feed_->cell()->name(), run));
  answer(foxglove::advertise_text(feed_->model()));
  feed_->add(*this);  // last: if anything throws, the session is not registered
}

void FoxgloveSession::answer(std::string text) {
  answer_bytes_ += text.size();
  answers_.push_back(std::make_shared<const std::string>(std::move(text)));
}

asio::awaitable<void> FoxgloveSession::handle(std::string_view message) {
  const foxglove::Subscriptions::Subscribed outcome = subscriptions_.carry_out(message);
  if (!outcome.complaint.empty())
    answer(foxglove::status_text(StatusLevel::kWarning, outcome.complaint));
  for (const Topic topic : outcome.added) begin(topic);
  sink_.pump();
  co_return;
}

/// Sends the latest message of a topic that the client has subscribed to.
void FoxgloveSession::begin(Topic topic) {
  if (topic == Topic::kEvents) {
    next_event_ = feed_->events_end();
  } else {
    due_.set(index_of(topic));
  }
  if (topic == Topic::kCamera && !feed_->follow_camera())
    answer(foxglove::status_text(StatusLevel::kWarning,
                                 "/camera has no messages: this workcell has no camera"));
}

void FoxgloveSession::offer(const TopicSet& changed) {
  due_ |= changed;
  sink_.pump();
}

void FoxgloveSession::end(monitor::CloseReason why) {
  close_reason_ = why;
  sink_.pump();
}

// --- Output.

std::optional<WebsocketMessage> FoxgloveSession::next_output() {
  if (!answers_.empty()) return next_answer();
  if (close_reason_) return std::nullopt;
  if (std::exchange(time_, feed_->time()) != feed_->time())
    return WebsocketMessage{WebsocketMessage::Type::kBinary, foxglove::time_bytes(*time_)};
  if (auto message = next_due()) return message;
  return next_event();
}

std::optional<WebsocketMessage> FoxgloveSession::next_answer() {
  monitor::Message text = std::move(answers_.front());
  answers_.pop_front();
  answer_bytes_ -= text->size();
  return WebsocketMessage{WebsocketMessage::Type::kText, "", std::move(text)};
}

/// The next topic that is due. All messages have the time that was sent before them.
std::optional<WebsocketMessage> FoxgloveSession::next_due() {
  for (const foxglove::TopicInfo& info : foxglove::topics()) {
    if (!due_.test(index_of(info.topic))) continue;
    due_.reset(index_of(info.topic));
    const std::optional<std::uint32_t> number = subscriptions_.find(info.topic);
    monitor::Message text = number ? feed_->text(info.topic) : nullptr;
    if (text)
      return WebsocketMessage{WebsocketMessage::Type::kBinary,
                              foxglove::message_head(*number, *time_), std::move(text)};
  }
  return std::nullopt;
}

/// The next event, or the number of those that the ring of the cell has dropped.
std::optional<WebsocketMessage> FoxgloveSession::next_event() {
  const std::optional<std::uint32_t> number = subscriptions_.find(Topic::kEvents);
  if (!number || next_event_ >= feed_->events_end()) return std::nullopt;
  const std::int64_t wanted = next_event_;
  auto event = feed_->event(wanted);
  next_event_ = event ? event->seq + 1 : feed_->events_end();
  if (!event) return std::nullopt;
  if (event->seq > wanted) {
    answer(foxglove::status_text(
        StatusLevel::kWarning,
        "/events: " + std::to_string(event->seq - wanted) +
            " messages were dropped, since this client reads more slowly than they are made"));
  }
  return WebsocketMessage{WebsocketMessage::Type::kBinary, foxglove::message_head(*number, *time_),
                          std::make_shared<const std::string>(std::move(event->text))};
}

}  // namespace xr3
