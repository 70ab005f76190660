#include "service/frames.hpp"

#include <algorithm>
#include <limits>

namespace xr3::service {
namespace {

constexpr WallNs kSecond = 1'000'000'000;

/// Offers the current frame. Returns whether the subscription is settled.
bool offer(monitor::FrameSubscription& subscription, FrameCache& frames, monitor::FrameNumber now) {
  const monitor::Frame* frame = frames.frame(subscription.wanted().selection);
  if (frame == nullptr) return true;  // no camera
  subscription.offer(*frame, now);
  return subscription.is_settled(*frame);
}

}  // namespace

// Converts seconds and the fraction separately, since the product of all nanoseconds would
// overflow.
monitor::FrameNumber frame_at(WallNs now) {
  return now / kSecond * monitor::kFramesPerSecond +
         now % kSecond * monitor::kFramesPerSecond / kSecond;
}

OfferedFrames offer_due_frames(monitor::Client& client, const std::string& name, FrameCache& frames,
                               monitor::FrameNumber now) {
  OfferedFrames offered{.due = std::numeric_limits<monitor::FrameNumber>::max()};
  client.for_each_frame_subscription(name, [&](monitor::FrameSubscription& subscription) {
    const bool is_settled = subscription.is_due(now) && offer(subscription, frames, now);
    offered.is_settled = offered.is_settled && is_settled;
    offered.is_waiting = offered.is_waiting || subscription.is_waiting();
    offered.due = std::min(offered.due, subscription.due());
  });
  return offered;
}

}  // namespace xr3::service
