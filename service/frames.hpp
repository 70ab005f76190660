// The grid in time on which frames are made, and the offer of those that are due.
#pragma once

#include "cell/frames.hpp"
#include "protocol/monitor/client.hpp"

namespace xr3::service {

/// The point of the grid at this time.
monitor::FrameNumber frame_at(WallNs now);

/// What is left to do for a client after offer_due_frames().
struct OfferedFrames {
  bool is_waiting = false;  ///< a frame is in a slot
  bool is_settled = true;   ///< no subscription waits for a later frame
  /// The point of the grid from which to offer again; the greatest number if it follows no frames.
  monitor::FrameNumber due;
};

/// Offers the client, for each of its subscriptions to the cell `name` that is due, the current
/// frame. A frame is encoded only if it is due.
OfferedFrames offer_due_frames(monitor::Client& client, const std::string& name, FrameCache& frames,
                               monitor::FrameNumber now);

}  // namespace xr3::service
