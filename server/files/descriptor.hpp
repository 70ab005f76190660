// File descriptors that close themselves.
#pragma once

#include <unistd.h>

#include <string_view>
#include <utility>

#include "server/files/interrupted.hpp"

namespace xr3 {

/// Owns a file descriptor; negative if there is none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (is_open()) ::close(number_);
  }

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// Writes all bytes to a file or pipe that blocks. Returns whether it succeeded; if not, errno has
/// the error.
inline bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto count = retry_interrupted([&] { return ::write(file, bytes.data(), bytes.size()); });
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace xr3
