#include "server/monitor_port/subscribers.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <limits>
#include <new>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr WallNs kSecond = 1'000'000'000;

// Number of sessions served, in some 25 us, before robot lines get a turn. More would be
// noticeable; each turn costs a system call.
constexpr std::size_t kSessionsBetween = 4;

// Maximum number of selections whose frames exist at a time, apart from those of one session more.
// With 10,000 blocks a frame has 2 MB.
constexpr std::size_t kMaxMade = 8;

// Maximum distance of two rounds while time runs, so that events caused by time (such as a stall)
// arrive within a few hundredths of a second.
constexpr monitor::FrameNumber kMaxFramesApart = 2;

/// The wall time at which a frame begins.
WallNs start_of(monitor::FrameNumber frame) {
  const auto seconds = frame / monitor::kFramesPerSecond;
  const auto rest = frame % monitor::kFramesPerSecond;
  return seconds * kSecond +
         (rest * kSecond + monitor::kFramesPerSecond - 1) / monitor::kFramesPerSecond;
}

}  // namespace

// Converts seconds and the fraction separately, since the product of all nanoseconds would
// overflow.
monitor::FrameNumber SubscriberHub::wall_frame() {
  const WallNs wall = wall_now();
  return wall / kSecond * monitor::kFramesPerSecond +
         wall % kSecond * monitor::kFramesPerSecond / kSecond;
}

SubscriberHub::~SubscriberHub() {
  for (MonitorSession* session : sessions_) session->leave(*this);
}

// Without memory, neither of the two knows the other.
void SubscriberHub::add(MonitorSession& session) {
  if (!session.join(*this)) return;
  try {
    sessions_.push_back(&session);
  } catch (const std::bad_alloc&) {
    session.leave(*this);
    throw;
  }
}

void SubscriberHub::remove(MonitorSession& session) {
  const auto found = std::ranges::find(sessions_, &session);
  if (found == sessions_.end()) return;
  const auto index = static_cast<std::size_t>(found - sessions_.begin());
  sessions_.erase(found);
  session.leave(*this);
  if (index < next_) --next_;
}

bool SubscriberHub::has_followers() const {
  return std::any_of(sessions_.begin(), sessions_.end(), [](const MonitorSession* session) {
    return session->client().follows_anything();
  });
}

// --- Timing.

void SubscriberHub::acted() {
  vital("the sessions", [this] { wake_soon(); });
}

void SubscriberHub::wake_soon() {
  has_acted_ = true;
  if (is_stopped_ || is_serving_) return;
  if (armed_ == Wake::kFrame && armed_frame_ <= wall_frame() + 1) return;
  if (!sessions_.empty() && has_followers()) return arm_frame();
  const bool runs = cell_.has_news_to_come();
  if (runs && armed_ == Wake::kNone) arm_second();
}

// Serves at once if the current frame has not been served yet, so that messages are not delayed.
void SubscriberHub::arm_frame() {
  const monitor::FrameNumber now = wall_frame();
  if (now == frame_) return arm_at(now + 1);
  armed_ = Wake::kFrame;
  armed_frame_ = now;
  timer_.cancel();
  asio::post(io_, [this] { beat(); });
}

void SubscriberHub::arm_at(monitor::FrameNumber frame) {
  armed_frame_ = frame;
  arm(Wake::kFrame, start_of(frame));
}

void SubscriberHub::arm_second() { arm(Wake::kSecond, wall_now() + kSecond); }

void SubscriberHub::arm(Wake wake, WallNs when) {
  armed_ = wake;
  run_at(timer_, when, [this] { beat(); });
}

void SubscriberHub::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

// --- Serving.

void SubscriberHub::beat() {
  armed_ = Wake::kNone;
  if (is_stopped_ || is_serving_) return;
  cell_.catch_up(wall_now());
  begin_round();
}

void SubscriberHub::begin_round() {
  is_serving_ = true;
  has_acted_ = false;
  is_settled_ = true;
  due_ = std::numeric_limits<monitor::FrameNumber>::max();
  next_ = 0;
  frame_ = wall_frame();
  go_on();
}

/// Serves the next sessions, or ends the round.
void SubscriberHub::go_on() {
  if (is_stopped_ || next_ >= sessions_.size()) return end_round();
  std::vector<monitor::Selection> selections = select_slow_frames();
  if (selections.empty()) return serve_some();
  spawn_loop(io_.get_executor(), "the subscribers", make_and_serve(std::move(selections), keep_()));
}

/// The frames that the worker has to make for the next sessions, without those whose clients have
/// yet to accept a frame. Sets share_ so that there are few, which bounds their memory.
std::vector<monitor::Selection> SubscriberHub::select_slow_frames() {
  share_ = kFairShare;
  if (!frames_.is_any_slow()) return {};
  std::vector<monitor::Selection> selections;
  const auto select = [&, this](const monitor::FrameSubscription& subscription) {
    const monitor::Selection& wanted = subscription.wanted().selection;
    const bool is_new = std::find(selections.begin(), selections.end(), wanted) == selections.end();
    if (is_new && subscription.is_due(frame_) && frames_.is_slow(wanted.channel))
      selections.push_back(wanted);
  };
  const std::size_t most = std::min(kFairShare, sessions_.size() - next_);
  for (share_ = 0; share_ < most && selections.size() < kMaxMade; ++share_) {
    MonitorSession& session = *sessions_[next_ + share_];
    if (!session.is_blocked()) session.client().for_each_frame_subscription(cell_.name(), select);
  }
  return selections;
}

// `kept` outlives the coroutine.
asio::awaitable<void> SubscriberHub::make_and_serve(std::vector<monitor::Selection> selections,
                                                    std::shared_ptr<void> kept) {
  std::vector<SelectedFrame> made = co_await frames_.make(std::move(selections));
  made_ = std::move(made);
  serve_some();
  static_cast<void>(kept);
}

void SubscriberHub::serve_some() {
  const std::size_t end = next_ + share_;
  while (next_ < std::min(end, sessions_.size())) {
    prefetch();
    serve(*sessions_[next_++]);
    if (next_ % kSessionsBetween == 0) between_();
  }
  made_.clear();
  if (next_ >= sessions_.size() || is_stopped_) return end_round();
  asio::post(io_, [this] { go_on(); });
}

/// Prefetches for the next sessions: the farthest one at depth 0, each nearer one a depth more.
void SubscriberHub::prefetch() const {
  for (std::size_t depth = 0; depth < kDepths; ++depth) {
    const std::size_t ahead = next_ + kDepths - depth;
    if (ahead < sessions_.size()) sessions_[ahead]->prefetch(static_cast<Depth>(depth));
  }
}

void SubscriberHub::serve(MonitorSession& session) {
  bool has_frame = false;
  const auto offer_due = [&, this](monitor::FrameSubscription& subscription) {
    const bool is_settled = subscription.is_due(frame_) && offer_frame(subscription);
    is_settled_ = is_settled_ && is_settled;
    due_ = std::min(due_, subscription.due());
    has_frame = has_frame || subscription.is_waiting();
  };
  session.client().for_each_frame_subscription(cell_.name(), offer_due);
  if (has_frame || session.client().has_output(frame_)) session.wake();
}

/// Offers the current frame. Returns whether the subscription is settled. Called only when it is
/// due, so that no frame is encoded needlessly.
bool SubscriberHub::offer_frame(monitor::FrameSubscription& subscription) {
  const monitor::Selection& wanted = subscription.wanted().selection;
  if (frames_.is_slow(wanted.channel)) return offer_made_frame(subscription);
  return offer(subscription, frames_.at_once(wanted));
}

/// Offers the frame from the worker. A subscription that began in the meantime has none yet.
bool SubscriberHub::offer_made_frame(monitor::FrameSubscription& subscription) {
  const monitor::Selection& wanted = subscription.wanted().selection;
  const auto found = std::ranges::find(made_, wanted, &SelectedFrame::first);
  if (found == made_.end()) return false;
  return offer(subscription, found->second ? &*found->second : nullptr);
}

/// Offers a frame, or nullptr without a camera. Returns whether the subscription is settled.
bool SubscriberHub::offer(monitor::FrameSubscription& subscription,
                          const monitor::Frame* frame) const {
  if (frame == nullptr) return true;
  subscription.offer(*frame, frame_);
  return subscription.is_settled(*frame);
}

void SubscriberHub::end_round() {
  is_serving_ = false;
  if (is_stopped_) return;
  const bool runs = cell_.has_news_to_come();
  if (!has_followers()) {
    if (runs) arm_second();
  } else if (has_acted_) {
    arm_frame();
  } else if (runs || !is_settled_) {
    const auto apart = runs ? kMaxFramesApart : monitor::kFramesPerSecond;
    arm_at(std::clamp(due_, frame_ + 1, frame_ + apart));
  }
}

}  // namespace xr3
