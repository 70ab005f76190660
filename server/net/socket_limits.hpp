// The numbers of sockets that the ports may hold open, so that the process never runs out of
// descriptors: then it could neither serve health checks nor log why.
#pragma once

#include <cstddef>

#include "server/net/peer_counts.hpp"

namespace xr3 {

struct SocketLimits {
  std::size_t lines = 64;          ///< serial lines; further connections are closed without a byte
  std::size_t connections = 1024;  ///< monitor connections; further ones are refused with an error
  std::size_t refusals = 64;       ///< connections being refused at once
  /// Connections of one address on each port; 0 for the default of peer_counts().
  std::size_t per_address = 0;
  std::size_t branches = 0;  ///< cells of the call `branch`, in addition to the others
};

/// The serial lines of one branch, at most.
inline constexpr std::size_t kLinesPerBranch = 8;

/// Divides this many descriptors: all of `wanted` if there are enough. Else lines get at most half,
/// and connections and refusals divide the rest in proportion. A few are left for the process and
/// health checks, and `listeners` for the robot ports of further cells. Branches get their
/// listeners and lines from the rest before the others, but at most a quarter of it.
SocketLimits divide_descriptors(std::size_t descriptors, const SocketLimits& wanted,
                                std::size_t listeners = 0);

/// Counts with this limit for each address. 0: `max_remote` for addresses of other machines, and no
/// limit for this one.
PeerCounts peer_counts(std::size_t per_address, std::size_t max_remote = PeerCounts::kUnlimited);

/// Raises the limit of open files as far as the system allows; returns it.
std::size_t raise_descriptor_limit();

}  // namespace xr3
