#include "protocol/monitor/client.hpp"

#include <algorithm>
#include <utility>

#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

constexpr std::int64_t kMaxFinal = 16;  // messages of a channel of a cell that closes

RequestError too_long() {
  return {{},
          "too_long",
          "a line has at most 262144 bytes",
          "the connection is closed; the rest was not read",
          {}};
}

}  // namespace

// --- Input.

std::optional<Request> Client::handle(std::string_view message) {
  return accept(read_request(message));
}

std::optional<Request> Client::accept(RequestReading reading) {
  if (close_reason_) return std::nullopt;
  if (Request* request = std::get_if<Request>(&reading)) return std::move(*request);
  send(result(std::get<RequestError>(reading)));
  return std::nullopt;
}

// --- The reply queue.

void Client::send(Message message) {
  if (close_reason_) return;
  reply_queue_bytes_ += message->size();
  reply_queue_.emplace_back(std::move(message));
}

std::size_t Client::held_bytes() const {
  std::size_t bytes = reply_queue_bytes_ + (overview_ ? overview_->waiting_bytes() : 0);
  for (const auto& [where, followed] : followed_) {
    if (const auto* frames = std::get_if<FrameSubscription>(&followed))
      bytes += frames->waiting_bytes();
  }
  return bytes;
}

void Client::replay(const std::shared_ptr<Feed>& feed, const std::string& cell, const Get& get,
                    const RequestId& id) {
  const std::int64_t wanted = get.since.value_or(feed->next() - kMaxRecalled);
  const Subscribe from{get.selection, {}, {}, std::max(wanted, feed->first())};
  if (!close_reason_)
    reply_queue_.emplace_back(
        Replay{{cell, from, feed, stats_of(get.selection.channel)}, feed->next(), id});
}

void Client::end(CloseReason why) {
  send(bye(why));
  if (!close_reason_) close_reason_ = why;
  followed_.clear();
  overview_.reset();
  last_turn_ = nullptr;
}

void Client::end(LineFault fault) {
  if (fault == LineFault::kTooLong) send(result(too_long()));
  end(fault == LineFault::kTooLong ? CloseReason::kTooLong : CloseReason::kNotJson);
}

Message Client::next_answer() {
  while (!reply_queue_.empty()) {
    if (auto* replay = std::get_if<Replay>(&reply_queue_.front())) {
      if (replay->from.position() < replay->end) {
        if (const Message message = replay->from.next_output()) return with_id(message, replay->id);
      }
      reply_queue_.pop_front();
      continue;
    }
    Message message = std::get<Message>(std::move(reply_queue_.front()));
    reply_queue_.pop_front();
    reply_queue_bytes_ -= message->size();
    return message;
  }
  return nullptr;
}

// --- Subscriptions.

FrameSubscription& Client::follow_frames(const std::string& cell, const Subscribe& wanted) {
  const Where where{cell, wanted.selection.channel};
  unfollow(cell, wanted.selection.channel);
  const auto entry =
      followed_.emplace(where, FrameSubscription(cell, wanted, stats_of(wanted.selection.channel)))
          .first;
  auto& frames = std::get<FrameSubscription>(entry->second);
  if (holds_frames(cell)) frames.hold();
  return frames;
}

void Client::hold_frames(const std::string& cell) {
  held_.insert(cell);
  for_each_frame_subscription(cell, [](FrameSubscription& frames) { frames.hold(); });
}

void Client::release_frames(const std::string& cell) {
  if (held_.erase(cell) == 0) return;
  for_each_frame_subscription(cell, [](FrameSubscription& frames) { frames.release(); });
}

void Client::follow_feed(const std::string& cell, const Subscribe& wanted,
                         const std::shared_ptr<Feed>& feed) {
  followed_.insert_or_assign(
      {cell, wanted.selection.channel},
      FeedSubscription(cell, wanted, feed, stats_of(wanted.selection.channel)));
}

void Client::unfollow(const std::string& cell, Channel channel) {
  const auto found = followed_.find({cell, channel});
  if (found == followed_.end()) return;
  if (last_turn_ == &found->first) last_turn_ = nullptr;
  followed_.erase(found);
}

void Client::finish(const std::string& cell) {
  held_.erase(cell);
  for (std::size_t i = 0; i < kChannels; ++i) {
    const auto channel = static_cast<Channel>(i);
    const auto found = followed_.find({cell, channel});
    if (found == followed_.end()) continue;
    if (auto* feed = std::get_if<FeedSubscription>(&found->second)) {
      feed->skip_to_last(kMaxFinal);
      while (Message message = feed->next_output()) send(std::move(message));
    }
    unfollow(cell, channel);
  }
}

bool Client::follows(const std::string& cell) const {
  const auto first = followed_.lower_bound({cell, Channel::kState});
  return first != followed_.end() && first->first.first == cell;
}

bool Client::has_output(FrameNumber now) const {
  if (!reply_queue_.empty() || (overview_ && overview_->is_waiting())) return true;
  return std::any_of(followed_.begin(), followed_.end(), [now](const auto& entry) {
    if (const auto* frames = std::get_if<FrameSubscription>(&entry.second))
      return frames->has_output(now);
    return std::get<FeedSubscription>(entry.second).has_output();
  });
}

Message Client::next_output(FrameNumber now) {
  if (Message answer = next_answer()) return answer;
  if (overview_ && overview_->is_waiting()) return overview_->next_output();
  return next_followed(now);
}

Message Client::next_followed(FrameNumber now) {
  auto turn = last_turn_ != nullptr && followed_.size() > 1 ? followed_.upper_bound(*last_turn_)
                                                            : followed_.begin();
  for (std::size_t i = 0; i < followed_.size(); ++i, ++turn) {
    if (turn == followed_.end()) turn = followed_.begin();
    auto* frames = std::get_if<FrameSubscription>(&turn->second);
    Message message =
        frames ? frames->next_output(now) : std::get<FeedSubscription>(turn->second).next_output();
    if (!message) continue;
    last_turn_ = &turn->first;
    return message;
  }
  return nullptr;
}

}  // namespace xr3::monitor
