#include "tests/support/allocations.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace xr3::test {
namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> most{0};
std::atomic<bool> is_exhausted{false};

void note(std::size_t bytes) {
  const std::size_t now = held += bytes;
  std::size_t before = most;
  while (before < now && !most.compare_exchange_weak(before, now)) {
  }
}

}  // namespace

Allocations::Allocations() : before_(held) { most = before_; }

std::size_t Allocations::peak() const { return std::max(most.load(), before_) - before_; }

NoMemory::NoMemory() { is_exhausted = true; }
NoMemory::~NoMemory() { is_exhausted = false; }

}  // namespace xr3::test

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (xr3::test::is_exhausted) return nullptr;
  void* memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory != nullptr) xr3::test::note(malloc_usable_size(memory));
  return memory;
}

void* operator new(std::size_t size) {
  if (void* memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  if (memory == nullptr) return;
  xr3::test::held -= malloc_usable_size(memory);
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { operator delete(memory); }
