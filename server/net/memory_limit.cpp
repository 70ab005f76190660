#include "server/net/memory_limit.hpp"

#include <malloc.h>
#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <utility>

// Provided by the address sanitizer, which replaces the allocator that mallinfo2() describes.
extern "C" __attribute__((weak)) std::size_t __sanitizer_get_current_allocated_bytes();

namespace xr3 {

std::size_t allocated_bytes() {
  if (__sanitizer_get_current_allocated_bytes != nullptr)
    return __sanitizer_get_current_allocated_bytes();
  const struct mallinfo2 heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

void MemoryLimit::note(std::size_t bytes) {
  noted_ += bytes;
  if (noted_ >= kBytesApart) schedule();
}

// Not at once: the caller may be the connection that has to be closed.
void MemoryLimit::schedule() {
  noted_ = 0;
  if (std::exchange(is_scheduled_, true)) return;
  asio::post(io_, [this] {
    is_scheduled_ = false;
    check();
  });
}

// Closes one connection, then measures again: several may have shared the bytes that it held.
void MemoryLimit::check() {
  const std::size_t allocated = allocated_bytes();
  if (allocated <= max_bytes_) return;
  if (close_greediest_()) return schedule();
  spdlog::warn("{} MiB of memory are allocated, more than --max-memory, but not for connections",
               allocated >> 20);
}

}  // namespace xr3
