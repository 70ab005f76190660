#include "server/lines/turn_peers.hpp"

namespace xr3 {

std::shared_ptr<TurnQueue::Peer> TurnPeers::at(const asio::ip::address* address) {
  if (address == nullptr) return std::make_shared<TurnQueue::Peer>();
  const auto known = peers_.find(*address);
  if (known != peers_.end())
    if (auto peer = known->second.lock()) return peer;
  auto peer = std::make_shared<TurnQueue::Peer>();
  peers_[*address] = peer;
  forget_unused();
  return peer;
}

// When their number has doubled, so that a new address costs the same however many there are.
void TurnPeers::forget_unused() {
  if (peers_.size() <= most_) return;
  std::erase_if(peers_, [](const auto& each) { return each.second.expired(); });
  most_ = 2 * peers_.size();
}

}  // namespace xr3
