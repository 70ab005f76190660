#include "server/foxglove/feeds.hpp"

namespace xr3 {

std::shared_ptr<FoxgloveFeed> FoxgloveFeeds::feed_of(const CellPtr& at) {
  std::erase_if(feeds_, [](const auto& each) { return each.expired(); });
  for (const auto& each : feeds_)
    if (const auto feed = each.lock(); feed->cell() == at) return feed;
  const auto feed = std::make_shared<FoxgloveFeed>(executor_, at);
  feeds_.push_back(feed);
  return feed;
}

}  // namespace xr3
