#include "tests/seeds/memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

extern "C" {
void __sanitizer_print_stack_trace() __attribute__((weak));
// The counters below find leaks after each run.
const char* __asan_default_options() { return "detect_leaks=0"; }
}

namespace xr3::seeds {
namespace {

// In front of every block, aligned for any type.
struct alignas(std::max_align_t) Header {
  std::size_t bytes;
  bool is_counted;
};

std::atomic<std::int64_t> held{0};
std::atomic<std::int64_t> peak{0};
std::uint64_t count = 0;
std::uint64_t failed = 0;
std::uint64_t first_failure = kNoFailure;
std::uint64_t failures = 0;
bool shows_stacks = false;
thread_local int outside = 0;
bool is_counting = false;

bool must_fail() {
  const std::uint64_t number = count++;
  if (number < first_failure || number - first_failure >= failures) return false;
  ++failed;
  if (shows_stacks && __sanitizer_print_stack_trace != nullptr) {
    ++outside;
    __sanitizer_print_stack_trace();
    --outside;
  }
  return true;
}

void* allocate(std::size_t bytes) noexcept {
  const bool is_counted = outside == 0;
  if (is_counted && is_counting && must_fail()) return nullptr;
  auto* header = static_cast<Header*>(std::malloc(sizeof(Header) + bytes));
  if (header == nullptr) return nullptr;
  *header = {bytes, is_counted};
  if (is_counted) {
    const std::int64_t now = held += static_cast<std::int64_t>(bytes);
    std::int64_t before = peak;
    while (before < now && !peak.compare_exchange_weak(before, now)) {
    }
  }
  return header + 1;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  Header* header = static_cast<Header*>(memory) - 1;
  if (header->is_counted) held -= static_cast<std::int64_t>(header->bytes);
  std::free(header);
}

}  // namespace

Outside::Outside() { ++outside; }
Outside::~Outside() { --outside; }
Inside::Inside() : depth_(outside) { outside = 0; }
Inside::~Inside() { outside = depth_; }

void start_counting(std::uint64_t before, std::uint64_t how_many) {
  count = 0;
  failed = 0;
  first_failure = before;
  failures = how_many;
  is_counting = true;
  peak = held.load();
}

std::uint64_t allocation_count() { return count; }
std::uint64_t failed_allocations() { return failed; }
void show_failing_stacks(bool show) { shows_stacks = show; }
std::int64_t held_bytes() { return held; }
std::int64_t peak_bytes() { return peak; }

}  // namespace xr3::seeds

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return xr3::seeds::allocate(bytes);
}
void* operator new(std::size_t bytes) {
  if (void* memory = xr3::seeds::allocate(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t bytes) { return operator new(bytes); }
void operator delete(void* memory) noexcept { xr3::seeds::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { xr3::seeds::release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { xr3::seeds::release(memory); }
void operator delete[](void* memory) noexcept { xr3::seeds::release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { xr3::seeds::release(memory); }
