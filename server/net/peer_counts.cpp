#include "server/net/peer_counts.hpp"

namespace xr3 {

std::unique_ptr<PeerCounts::Place> PeerCounts::take(const asio::ip::address& peer) {
  const auto found = counts_.find(peer);
  const std::size_t count = found == counts_.end() ? 0 : found->second;
  if (count >= (peer.is_loopback() ? max_local_ : max_)) return nullptr;
  return std::make_unique<Place>(*this, peer);
}

PeerCounts::Place::~Place() {
  const auto found = counts_.counts_.find(peer_);
  if (--found->second == 0) counts_.counts_.erase(found);
}

asio::ip::address peer_address(const tcp::socket& socket) {
  ErrorCode lost;
  return socket.remote_endpoint(lost).address();
}

}  // namespace xr3
