#include "server/session/subscribers.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <limits>
#include <new>

#include "cell/failure.hpp"
#include "service/frames.hpp"

namespace xr3 {
namespace {

constexpr WallNs kSecond = 1'000'000'000;

// Number of sessions served, in some 25 us, before robot lines get a turn. More would be
// noticeable; each turn costs a system call.
constexpr std::size_t kSessionsBetween = 4;

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

monitor::FrameNumber SubscriberHub::wall_frame() { return service::frame_at(wall_now()); }

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

void SubscriberHub::changed() {
  fatal_if_throws("the sessions", [this] { wake_soon(); });
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
  asio::post(io_, [this] { on_timer(); });
}

void SubscriberHub::arm_at(monitor::FrameNumber frame) {
  armed_frame_ = frame;
  arm(Wake::kFrame, start_of(frame));
}

void SubscriberHub::arm_second() { arm(Wake::kSecond, wall_now() + kSecond); }

void SubscriberHub::arm(Wake wake, WallNs when) {
  armed_ = wake;
  run_at(timer_, when, [this] { on_timer(); });
}

void SubscriberHub::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

// --- Serving.

void SubscriberHub::on_timer() {
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
  serve_some();
}

/// Serves the next sessions. Ends the round after the last one.
void SubscriberHub::serve_some() {
  if (is_stopped_) return end_round();
  const std::size_t end = next_ + kFairShare;
  while (next_ < std::min(end, sessions_.size())) {
    serve(*sessions_[next_++]);
    if (next_ % kSessionsBetween == 0) run_lines_();
  }
  if (next_ >= sessions_.size() || is_stopped_) return end_round();
  asio::post(io_, [this] { serve_some(); });
}

void SubscriberHub::serve(MonitorSession& session) {
  const service::OfferedFrames offered =
      service::offer_due_frames(session.client(), cell_.name(), frames_, frame_);
  is_settled_ = is_settled_ && offered.is_settled;
  due_ = std::min(due_, offered.due);
  if (offered.is_waiting || session.client().has_output(frame_)) session.wake();
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
