// Memory that will be needed soon is asked for ahead. Each of a thousand viewers is cold when its turn
// comes, and what it holds hangs on a chain of pointers: waiting for one after the other was half of
// what the server itself spent on a message.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace xr3 {

/// How many pointers away from a viewer something is. Each depth is asked for a viewer later than the
/// one before, which by then has brought the pointer.
enum class Depth : std::uint8_t { kItself, kHeld, kCarried, kSocket };
inline constexpr std::size_t kDepths = 4;

/// Asks the processor to bring an object, or the first part of a great one. Never waits.
template <class Object>
void prefetch(const Object* object) {
  constexpr std::size_t kLineBytes = 64;
  constexpr std::size_t kMostBytes = 512;
  const char* bytes = reinterpret_cast<const char*>(object);
  for (std::size_t i = 0; i < std::min(sizeof(Object), kMostBytes); i += kLineBytes)
    __builtin_prefetch(bytes + i);
}

}  // namespace xr3
