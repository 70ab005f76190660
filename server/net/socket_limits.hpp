// The numbers of sockets that the ports may hold open, so that the process never runs out of
// descriptors: then it could neither serve health checks nor log why.
#pragma once

#include <cstddef>

namespace xr3 {

struct SocketLimits {
  std::size_t lines = 1024;        ///< serial lines; further connections are closed without a byte
  std::size_t connections = 1024;  ///< monitor connections; further ones are refused with an error
  std::size_t refusals = 64;       ///< connections being refused at once
};

/// Divides this many descriptors: all of `wanted` if there are enough, else a proportional part. A
/// few are left for the process itself, its own probe, and health checks.
SocketLimits divide_descriptors(std::size_t descriptors, const SocketLimits& wanted);

/// Raises the limit of open files as far as the system allows; returns it.
std::size_t raise_descriptor_limit();

}  // namespace xr3
