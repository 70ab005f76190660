#include "server/net/peer_counts.hpp"

namespace xr3 {

PeerCounts::Place PeerCounts::take(const asio::ip::address& peer) {
  const auto place = counts_.try_emplace(peer).first;
  const bool is_full = place->second >= (peer.is_loopback() ? max_local_ : max_);
  if (!is_full) ++place->second;
  if (place->second == 0) counts_.erase(place);
  if (is_full) return nullptr;
  return {&place->first, [place, this](const asio::ip::address*) {
            if (--place->second == 0) counts_.erase(place);
          }};
}

}  // namespace xr3
