#include "server/net/socket_limits.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace xr3 {
namespace {

// Standard streams, event loop, listeners, signals, and files being read or written.
constexpr std::size_t kOwnDescriptors = 36;

// Several health checks can wait for their answers at once.
constexpr std::size_t kMinRefusals = 4;

// 127.0.0.1 and ::1, and its lines.
constexpr std::size_t kDescriptorsPerBranch = 2 + kLinesPerBranch;
constexpr std::size_t kBranchesPart = 4;

}  // namespace

SocketLimits divide_descriptors(std::size_t descriptors, const SocketLimits& wanted,
                                std::size_t listeners) {
  const std::size_t rest = descriptors - std::min(descriptors, kOwnDescriptors + listeners);
  const std::size_t branches =
      std::min(wanted.branches, rest / kBranchesPart / kDescriptorsPerBranch);
  const std::size_t free = rest - branches * kDescriptorsPerBranch;
  const std::size_t others = wanted.connections + wanted.refusals;
  if (wanted.lines + others <= free)
    return {wanted.lines, wanted.connections, wanted.refusals, wanted.per_address, branches};
  const std::size_t lines = std::clamp<std::size_t>(free / 2, 1, wanted.lines);
  const auto part = [&](std::size_t count, std::size_t least) {
    return std::clamp(count * (free - std::min(free, lines)) / others, least, count);
  };
  return {lines, part(wanted.connections, 1), part(wanted.refusals, kMinRefusals),
          wanted.per_address, branches};
}

PeerCounts peer_counts(std::size_t per_address, std::size_t max_remote) {
  if (per_address > 0) return PeerCounts(per_address, per_address);
  return PeerCounts(max_remote);
}

std::size_t raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return kOwnDescriptors;
  rlimit raised = limit;
  raised.rlim_cur = limit.rlim_max;
  const bool is_raised = ::setrlimit(RLIMIT_NOFILE, &raised) == 0;
  return static_cast<std::size_t>(is_raised ? raised.rlim_cur : limit.rlim_cur);
}

}  // namespace xr3
