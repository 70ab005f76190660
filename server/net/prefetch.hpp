// Prefetches memory that will be accessed soon. With a thousand monitor sessions each one is out of
// cache when its turn comes, and its data are reached through a chain of pointers: these cache
// misses were half of the server's own time per message.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace xr3 {

/// Distance from a session in pointers. The prefetch of each depth runs one session later than that
/// of the previous depth, which by then has loaded the pointer.
enum class Depth : std::uint8_t { kItself, kHeld, kCarried, kSocket };
inline constexpr std::size_t kDepths = 4;

/// Prefetches an object, or the first 512 bytes of a large one. Does not block.
template <class Object>
void prefetch(const Object* object) {
  constexpr std::size_t kLineBytes = 64;
  constexpr std::size_t kMaxBytes = 512;
  const char* bytes = reinterpret_cast<const char*>(object);
  for (std::size_t i = 0; i < std::min(sizeof(Object), kMaxBytes); i += kLineBytes)
    __builtin_prefetch(bytes + i);
}

}  // namespace xr3
