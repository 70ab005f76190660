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
  const std::size_t sum = wanted.lines + wanted.connections + wanted.refusals;
  const std::size_t rest = descriptors - std::min(descriptors, kOwnDescriptors + listeners);
  const std::size_t branches =
      std::min(wanted.branches, rest / kBranchesPart / kDescriptorsPerBranch);
  const std::size_t free = rest - branches * kDescriptorsPerBranch;
  if (sum <= free)
    return {wanted.lines, wanted.connections, wanted.refusals, wanted.per_address, branches};
  const auto part = [&](std::size_t count) { return std::max<std::size_t>(1, count * free / sum); };
  return {part(wanted.lines), part(wanted.connections),
          std::max(kMinRefusals, part(wanted.refusals)), wanted.per_address, branches};
}

PeerCounts peer_counts(std::size_t places, std::size_t per_address) {
  if (per_address > 0) return PeerCounts(per_address, per_address);
  return PeerCounts(places - places / 4);
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
