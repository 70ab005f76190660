#include "server/monitor_port/subscribers.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <limits>

#include "cell/failure.hpp"

namespace xr3 {
namespace {

constexpr WallNs kSecond = 1'000'000'000;

// Viewers that a robot line may have to wait for: some 25 us. More would be felt, fewer cost a system
// call each.
constexpr std::size_t kViewersBetween = 4;

// While time runs everybody is looked after at least so often: what time brings (a stall, a line that
// is told of) comes within a few hundredths of a second.
constexpr monitor::FrameNumber kMostApart = 2;

/// The first moment of a frame.
WallNs start_of(monitor::FrameNumber frame) {
  return (frame * kSecond + monitor::kFramesPerSecond - 1) / monitor::kFramesPerSecond;
}

void add(Audience::Tallies& sum, const Audience::Tallies& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].sent += more[i].sent;
    sum[i].overwritten += more[i].overwritten;
  }
}

}  // namespace

Audience::Tallies Audience::tallies() const {
  Tallies sum = gone_;
  for (Viewer* viewer : viewers_) xr3::add(sum, viewer->client().tallies());
  return sum;
}

// Seconds and the rest of one apart: a product of all nanoseconds would not fit.
monitor::FrameNumber Audience::wall_frame() {
  const WallNs wall = wall_now();
  return wall / kSecond * monitor::kFramesPerSecond +
         wall % kSecond * monitor::kFramesPerSecond / kSecond;
}

void Audience::remove(Viewer& viewer) {
  const auto found = std::find(viewers_.begin(), viewers_.end(), &viewer);
  if (found == viewers_.end()) return;
  const auto index = static_cast<std::size_t>(found - viewers_.begin());
  viewers_.erase(found);
  xr3::add(gone_, viewer.client().tallies());
  if (index < next_) --next_;
}

bool Audience::has_followers() const {
  return std::any_of(viewers_.begin(), viewers_.end(),
                     [](const Viewer* viewer) { return viewer->follows_anything(); });
}

// --- When.

void Audience::acted() {
  vital("the viewers", [this] { wake_soon(); });
}

void Audience::wake_soon() {
  has_acted_ = true;
  if (is_stopped_ || is_serving_) return;
  if (armed_ == Wake::kFrame && armed_frame_ <= wall_frame() + 1) return;
  if (!viewers_.empty() && has_followers()) return arm_frame();
  const bool runs = cell_.has_news_to_come();
  if (runs && armed_ == Wake::kNone) arm_second();
}

// At once where this frame has not been served yet, so that who waits for an answer need not wait.
void Audience::arm_frame() {
  const monitor::FrameNumber now = wall_frame();
  if (now == frame_) return arm_at(now + 1);
  armed_ = Wake::kFrame;
  armed_frame_ = now;
  timer_.cancel();
  asio::post(io_, [this] { beat(); });
}

void Audience::arm_at(monitor::FrameNumber frame) {
  armed_frame_ = frame;
  arm(Wake::kFrame, start_of(frame));
}

void Audience::arm_second() { arm(Wake::kSecond, wall_now() + kSecond); }

void Audience::arm(Wake wake, WallNs when) {
  armed_ = wake;
  timer_.expires_at(as_time_point(when));
  timer_.async_wait([this](ErrorCode cancelled) {
    if (!cancelled) beat();
  });
}

void Audience::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

// --- What.

void Audience::beat() {
  armed_ = Wake::kNone;
  if (is_stopped_ || is_serving_) return;
  cell_.catch_up(wall_now());
  begin_round();
}

void Audience::begin_round() {
  is_serving_ = true;
  has_acted_ = false;
  is_settled_ = true;
  due_ = std::numeric_limits<monitor::FrameNumber>::max();
  next_ = 0;
  frame_ = wall_frame();
  serve_some();
}

void Audience::serve_some() {
  const std::size_t end = std::min(viewers_.size(), next_ + kFairShare);
  while (next_ < std::min(end, viewers_.size())) {
    prefetch();
    serve(*viewers_[next_++]);
    if (next_ % kViewersBetween == 0) between_();
  }
  if (next_ < viewers_.size() && !is_stopped_) return asio::post(io_, [this] { serve_some(); });
  end_round();
}

/// The viewers whose turns come next: the farthest itself, each nearer one a depth more.
void Audience::prefetch() const {
  for (std::size_t depth = 0; depth < kDepths; ++depth) {
    const std::size_t ahead = next_ + kDepths - depth;
    if (ahead < viewers_.size()) viewers_[ahead]->prefetch(static_cast<Depth>(depth));
  }
}

void Audience::serve(Viewer& viewer) {
  bool has_frame = false;
  viewer.client().for_each_frame_subscription([&, this](monitor::FrameSubscription& subscription) {
    const bool is_settled = subscription.is_due(frame_) && look(subscription);
    is_settled_ = is_settled_ && is_settled;
    due_ = std::min(due_, subscription.due());
    has_frame = has_frame || subscription.is_waiting();
  });
  if (has_frame || viewer.client().has_output(frame_)) viewer.wake();
}

/// Whether the client has, or will have, all that there is. Until it is due no text is made for it.
bool Audience::look(monitor::FrameSubscription& subscription) {
  const monitor::Frame* frame = frames_.current(subscription.wanted().selection);
  if (frame == nullptr) return true;
  subscription.offer(*frame, frame_);
  return subscription.is_settled(*frame);
}

void Audience::end_round() {
  is_serving_ = false;
  if (is_stopped_) return;
  const bool runs = cell_.has_news_to_come();
  if (!has_followers()) {
    if (runs) arm_second();
  } else if (has_acted_) {
    arm_frame();
  } else if (runs || !is_settled_) {
    const auto apart = runs ? kMostApart : monitor::kFramesPerSecond;
    arm_at(std::clamp(due_, frame_ + 1, frame_ + apart));
  }
}

}  // namespace xr3
