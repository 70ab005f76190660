// How far a session is prefetched. With a thousand monitor sessions each one is out of cache when
// its turn comes, and its data are reached through a chain of pointers: these cache misses were
// half of the server's own time per message.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/prefetch.hpp"

namespace xr3 {

/// Distance from a session in pointers. The prefetch of each depth runs one session later than that
/// of the previous depth, which by then has loaded the pointer.
enum class Depth : std::uint8_t { kItself, kHeld, kCarried, kSocket };
inline constexpr std::size_t kDepths = 4;

}  // namespace xr3
