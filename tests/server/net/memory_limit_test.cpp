#include "server/net/memory_limit.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace xr3 {
namespace {

constexpr std::size_t kMib = std::size_t{1} << 20;

/// Connections that hold some bytes each; the last one is closed first.
struct Connections {
  std::vector<std::vector<char>> held;
  std::size_t close_one() {
    if (held.empty()) return 0;
    const std::size_t bytes = held.back().size();
    held.pop_back();
    return bytes;
  }
};

TEST(MemoryLimit, ClosesConnectionsUntilEnoughIsFree) {
  asio::io_context io;
  Connections connections;
  MemoryLimit limit(io, allocated_bytes() + 10 * kMib, [&] { return connections.close_one(); });
  for (std::size_t i = 0; i < 5; ++i) {
    connections.held.emplace_back(4 * kMib);
    limit.note(4 * kMib);
    EXPECT_EQ(connections.held.size(), i + 1) << "not within note()";
  }
  io.run();
  EXPECT_EQ(connections.held.size(), 2U);
}

TEST(MemoryLimit, BelowItNothingIsClosed) {
  asio::io_context io;
  Connections connections;
  MemoryLimit limit(io, allocated_bytes() + 10 * kMib, [&] { return connections.close_one(); });
  connections.held.emplace_back(4 * kMib);
  for (int i = 0; i < 100; ++i) limit.note(kMib);
  io.run();
  EXPECT_EQ(connections.held.size(), 1U);
}

TEST(MemoryLimit, EndsIfNoConnectionHoldsAnything) {
  asio::io_context io;
  MemoryLimit limit(io, 1, [] { return std::size_t{0}; });
  limit.note(4 * kMib);
  EXPECT_EQ(io.run(), 1U);
}

}  // namespace
}  // namespace xr3
