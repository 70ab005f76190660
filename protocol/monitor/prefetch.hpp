// Prefetches memory that will be accessed soon, so that nothing waits for it then.
#pragma once

#include <algorithm>
#include <cstddef>

namespace xr3 {

/// Prefetches an object, or the first 512 bytes of a large one. Does not block. It is always
/// inlined: g++ drops the call of a function that does nothing but prefetch.
template <class Object>
[[gnu::always_inline]] inline void prefetch(const Object* object) {
  constexpr std::size_t kLineBytes = 64;
  constexpr std::size_t kMaxBytes = 512;
  const char* bytes = reinterpret_cast<const char*>(object);
  for (std::size_t i = 0; i < std::min(sizeof(Object), kMaxBytes); i += kLineBytes)
    __builtin_prefetch(bytes + i);
}

}  // namespace xr3
