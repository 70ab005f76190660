// The requests `sub`, `unsub` and `get` on the channels of a cell.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "cell/frames.hpp"
#include "protocol/monitor/client.hpp"

namespace xr3::service {

/// Beyond this number a client gets no further subscription.
inline constexpr std::size_t kMaxSubscriptions = 256;

/// A cell whose channels a client reads, advanced to the present. Subscriptions keep the cell.
struct WatchedCell {
  std::shared_ptr<Cell> cell;
  FrameCache& frames;
  monitor::FrameNumber now;  ///< the point of the grid at which frames are made
};

// Each answers the request itself. Precondition: the channel is not the overview.

/// Returns whether the client follows the channel now.
bool subscribe(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
               const monitor::Subscribe& wanted);
void unsubscribe(const std::string& cell, monitor::Client& client, const monitor::RequestId& id,
                 const monitor::Unsubscribe& wanted);
void get(const WatchedCell& at, monitor::Client& client, const monitor::RequestId& id,
         const monitor::Get& wanted);

}  // namespace xr3::service
