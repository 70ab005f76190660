// The number of connections of each peer address, with a limit (`--max-per-address`), so that one
// machine cannot use every place.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <memory>

#include "server/net/asio.hpp"

namespace xr3 {

class PeerCounts {
 public:
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  /// `max_local` is the limit for addresses of this machine.
  explicit PeerCounts(std::size_t max = kUnlimited, std::size_t max_local = kUnlimited)
      : max_(max), max_local_(max_local) {}

  /// The place of one connection, until it is released; points to the peer's address.
  using Place = std::shared_ptr<const asio::ip::address>;

  /// Takes a place; nullptr if the address has its maximum of connections. The counts must outlive
  /// the place.
  Place take(const asio::ip::address& peer);

 private:
  std::size_t max_;
  std::size_t max_local_;
  using Counts = std::map<asio::ip::address, std::size_t>;
  Counts counts_;
};

}  // namespace xr3
