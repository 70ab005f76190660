// What TurnQueue knows of each peer address that has lines.
#pragma once

#include <map>
#include <memory>

#include "server/lines/turn_queue.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class TurnPeers {
 public:
  /// The peer of this address, the same one for all lines of it that exist at the same time.
  /// Without an address (nullptr), as for a pseudo-terminal, each call returns a new peer.
  std::shared_ptr<TurnQueue::Peer> at(const asio::ip::address* address);

  /// The number of addresses that are known, some of which may have no line any more.
  std::size_t size() const { return peers_.size(); }

 private:
  void forget_unused();

  std::map<asio::ip::address, std::weak_ptr<TurnQueue::Peer>> peers_;
  std::size_t most_ = 0;  ///< forget_unused() is due beyond
};

}  // namespace xr3
