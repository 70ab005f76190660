// The feeds of the cells that have Foxglove clients.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/foxglove/session.hpp"

namespace xr3 {

class FoxgloveFeeds {
 public:
  explicit FoxgloveFeeds(asio::io_context& io)
      : executor_(io.get_executor()), run_(std::to_string(wall_now())) {}

  /// A session of a client with a cell.
  std::unique_ptr<FoxgloveSession> open(MessageSink& sink, const CellPtr& at) {
    return std::make_unique<FoxgloveSession>(sink, feed_of(at), run_);
  }

 private:
  std::shared_ptr<FoxgloveFeed> feed_of(const CellPtr& at);

  asio::any_io_executor executor_;
  std::string run_;  ///< differs between runs of the server
  std::vector<std::weak_ptr<FoxgloveFeed>> feeds_;
};

}  // namespace xr3
