// Prefetches memory that will be accessed soon, so that nothing waits for it then.
#pragma once

#include <algorithm>
#include <cstddef>

namespace xr3 {

/// Prefetches an object, or the first 512 bytes of a large one; nothing if it is null. Does not
/// block. It is always inlined: g++ drops the call of a function that does nothing but prefetch.
template <class Object>
[[gnu::always_inline]] inline void prefetch(const Object* object) {
  if (object == nullptr) return;
  constexpr std::size_t kLineBytes = 64;
  constexpr std::size_t kMaxBytes = 512;
  constexpr std::size_t kBytes = std::min(sizeof(Object), kMaxBytes);
  const char* bytes = reinterpret_cast<const char*>(object);
  for (std::size_t i = 0; i < kBytes; i += kLineBytes) __builtin_prefetch(bytes + i);
  __builtin_prefetch(bytes + kBytes - 1);  // the object may begin within a line
}

/// Prefetches what a value points to. The value itself is in the cache. Overloads exist for types
/// of which many values are accessed in turn.
template <class Value>
void prefetch_held(const Value&) {}

}  // namespace xr3
