#include "protocol/monitor/subscription.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <utility>

namespace xr3::monitor {
namespace {

// Divides time into slots of 1/rate, with at most one frame each. Returns the first frame of the
// next slot.
FrameNumber next_slot(FrameNumber now, MilliHz rate) {
  constexpr std::int64_t kMilliFrames = kFramesPerSecond * 1000;
  const std::int64_t slot = now * rate / kMilliFrames;
  return ((slot + 1) * kMilliFrames + rate - 1) / rate;
}

}  // namespace

ContentId content_id(std::string_view content) {
  return {std::hash<std::string_view>{}(content), content.size()};
}

// --- Latest-wins channels.

void FrameSubscription::hold() {
  is_held_ = true;
  due_ = std::numeric_limits<FrameNumber>::max();
  waiting_ = {};
  missed_ = {};
}

void FrameSubscription::release() {
  is_held_ = false;
  due_ = 0;
  sent_ = {};
}

void FrameSubscription::offer(const Frame& frame, FrameNumber now) {
  if (is_held_) return;
  due_ = next_slot(now, std::max(wanted_.max_millihz, kMinCheckMilliHz));
  if (wanted_.on_change && waiting_.message && frame.content == waiting_.content) return;
  const bool is_old = wanted_.on_change && frame.content == sent_;
  if (is_old && !waiting_.message) return;
  miss_waiting();
  if (is_old) return;  // back to the content that the client has
  waiting_ = frame;
  due_ = next_slot(now, wanted_.max_millihz);
}

void FrameSubscription::miss_waiting() {
  if (!waiting_.message) return;
  if (missed_.count++ == 0) missed_.from_seq = waiting_.seq;
  missed_.to_seq = waiting_.seq;
  ++stats_->overwritten;
  waiting_ = {};
}

bool FrameSubscription::is_settled(const Frame& current) const {
  if (is_held_) return true;
  if (!wanted_.on_change || missed_.count > 0) return false;
  return current.content == (waiting_.message ? waiting_.content : sent_);
}

bool FrameSubscription::is_lag_due(FrameNumber now) const {
  return missed_.count > 0 && now >= last_lag_ + kFramesPerSecond;
}

Message FrameSubscription::next_output(FrameNumber now) {
  if (is_lag_due(now)) {
    last_lag_ = now;
    return lag(cell_, wanted_.selection.channel, std::exchange(missed_, {}));
  }
  if (!waiting_.message) return nullptr;
  ++stats_->sent;
  sent_ = waiting_.content;
  Message message = std::move(waiting_.message);
  waiting_ = {};
  return message;
}

// --- The overview.

void OverviewSubscription::offer(Message message, std::int64_t seq, FrameNumber now) {
  assert(!is_waiting());
  waiting_ = std::move(message);
  seen_ = seq;
  due_ = next_slot(now, max_millihz_);
}

Message OverviewSubscription::next_output() {
  if (waiting_) ++stats_->sent;
  return std::exchange(waiting_, nullptr);
}

// --- Channels without loss.

FeedSubscription::FeedSubscription(std::string cell, const Subscribe& wanted,
                                   const std::shared_ptr<Feed>& feed, ChannelStats& stats)
    : cell_(std::move(cell)), wanted_(wanted), feed_(feed), stats_(&stats), next_(feed->next()) {
  if (wanted.since) next_ = std::clamp<std::int64_t>(*wanted.since, 1, feed->next());
}

void FeedSubscription::skip_to_last(std::int64_t most) {
  const std::shared_ptr<Feed> feed = feed_.lock();
  if (feed && feed->next() - next_ > most) skipped_to_ = feed->next() - 1;
}

Message FeedSubscription::next_output() {
  const std::shared_ptr<Feed> feed = feed_.lock();
  if (!feed) return nullptr;
  const std::int64_t first = std::max(feed->first(), skipped_to_);
  if (next_ < first) {
    const Missed missed{first - next_, next_, first - 1};
    stats_->overwritten += static_cast<std::uint64_t>(missed.count);
    next_ = first;
    return lag(cell_, wanted_.selection.channel, missed);
  }
  if (next_ >= feed->next()) return nullptr;
  ++stats_->sent;
  return with_fields(feed->at(next_++), wanted_.selection.fields);
}

}  // namespace xr3::monitor
