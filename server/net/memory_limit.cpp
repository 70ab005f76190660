#include "server/net/memory_limit.hpp"

#include <malloc.h>
#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <utility>

// Provided by the address sanitizer, which replaces the allocator that mallinfo2() describes.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): of the sanitizers
extern "C" __attribute__((weak)) std::size_t __sanitizer_get_current_allocated_bytes();

namespace xr3 {

std::size_t allocated_bytes() {
  if (__sanitizer_get_current_allocated_bytes != nullptr)
    return __sanitizer_get_current_allocated_bytes();
  const struct mallinfo2 heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

// Makes the allocator return freed blocks. Without a fixed threshold, it raises its threshold up to
// 32 MiB, and freed blocks of connections stay in the heap as holes: 700 MiB for 512 MiB in use.
void return_freed_blocks() {
  constexpr int kBlockBytes = 128 * 1024;
  ::mallopt(M_MMAP_THRESHOLD, kBlockBytes);
}

void MemoryLimit::note(std::size_t bytes) {
  noted_ += bytes;
  if (noted_ >= kBytesApart) schedule();
}

// Posts a check. Not at once: the caller may be the connection that has to be closed.
void MemoryLimit::schedule() {
  noted_ = 0;
  if (std::exchange(is_scheduled_, true)) return;
  asio::post(io_, [this] {
    is_scheduled_ = false;
    check();
  });
}

// Measures, closes connections, and measures again: several connections may have shared bytes of
// one that was closed.
void MemoryLimit::check() {
  const std::size_t allocated = allocated_bytes();
  if (allocated <= max_bytes_) return;
  if (close_some(allocated - max_bytes_) > 0) return schedule();
  spdlog::warn("{} MiB of memory are allocated, more than --max-memory, but not for connections",
               allocated >> 20);
}

/// Closes connections that hold `excess` bytes together, but at most kMaxClosed, since the search
/// for each takes some 20 us. Returns the bytes that they held.
std::size_t MemoryLimit::close_some(std::size_t excess) {
  constexpr int kMaxClosed = 16;
  std::size_t closed = 0;
  for (int i = 0; i < kMaxClosed && closed < excess; ++i) {
    const std::size_t held = close_greediest_();
    if (held == 0) break;
    closed += held;
  }
  return closed;
}

}  // namespace xr3
