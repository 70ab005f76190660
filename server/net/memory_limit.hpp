// The limit of the memory that the process may allocate (`--max-memory`). A single connection is
// bounded by its own queues; many together are bounded here. Beyond the limit, the connections that
// hold the most bytes are closed, one after the other, until enough is free.
#pragma once

#include <cstddef>
#include <functional>

#include "server/net/asio.hpp"

namespace xr3 {

/// The bytes that the process has allocated from the heap now.
std::size_t allocated_bytes();

/// Makes the allocator return large blocks to the system as soon as they are freed.
void return_freed_blocks();

class MemoryLimit {
 public:
  /// Closes the connection that holds the most bytes. Returns the number of bytes; 0 if no
  /// connection holds any.
  using CloseGreediest = std::function<std::size_t()>;

  MemoryLimit(asio::io_context& io, std::size_t max_bytes, CloseGreediest close_greediest)
      : io_(io), max_bytes_(max_bytes), close_greediest_(std::move(close_greediest)) {}

  /// Counts bytes that a connection has received or queued; call for all of them. After every
  /// kBytesApart bytes the memory is measured, in the next turn of the event loop.
  void note(std::size_t bytes);

  /// Whether more is allocated now. Takes some microseconds.
  bool is_exceeded() const { return allocated_bytes() > max_bytes_; }

  std::size_t max_bytes() const { return max_bytes_; }

  static constexpr std::size_t kBytesApart = std::size_t{4} * 1024 * 1024;

 private:
  void check();
  std::size_t close_some(std::size_t excess);
  void schedule();

  asio::io_context& io_;
  std::size_t max_bytes_;
  CloseGreediest close_greediest_;
  std::size_t noted_ = 0;  ///< bytes since the last measurement
  bool is_scheduled_ = false;
};

/// Counts bytes of a connection if there is a limit.
inline void note(MemoryLimit* limit, std::size_t bytes) {
  if (limit != nullptr) limit->note(bytes);
}

}  // namespace xr3
