#include "server/net/socket_limits.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr SocketLimits kWanted{1024, 1024, 64};

TEST(SocketLimits, AreThoseWantedIfThereAreEnoughDescriptors) {
  const SocketLimits limits = divide_descriptors(4096, kWanted);
  EXPECT_EQ(limits.lines, 1024U);
  EXPECT_EQ(limits.connections, 1024U);
  EXPECT_EQ(limits.refusals, 64U);
}

TEST(SocketLimits, LeaveSomeDescriptorsToTheProcess) {
  for (std::size_t descriptors = 64; descriptors < 2200; ++descriptors) {
    const SocketLimits limits = divide_descriptors(descriptors, kWanted);
    EXPECT_LE(limits.lines + limits.connections + limits.refusals, descriptors - 31) << descriptors;
  }
}

TEST(SocketLimits, LeaveDescriptorsToTheListenersOfManyCells) {
  const SocketLimits limits = divide_descriptors(4096, kWanted, 2000);
  EXPECT_EQ(limits.lines, 1024U);
  EXPECT_EQ(limits.connections, 975U);
  EXPECT_LE(limits.lines + limits.connections + limits.refusals, 4096U - 2000U);
}

TEST(SocketLimits, LeaveDescriptorsToBranches) {
  SocketLimits wanted = kWanted;
  wanted.branches = 4;
  for (std::size_t descriptors = 256; descriptors < 2400; ++descriptors) {
    const SocketLimits limits = divide_descriptors(descriptors, wanted);
    EXPECT_EQ(limits.branches, 4U);
    EXPECT_LE(limits.lines + limits.connections + limits.refusals + 4 * (kLinesPerBranch + 2),
              descriptors - 31)
        << descriptors;
  }
  wanted.branches = 1000;
  EXPECT_EQ(divide_descriptors(1024, wanted).branches, 24U) << "a quarter of the descriptors";
  EXPECT_EQ(divide_descriptors(20000, wanted).branches, 499U);
  EXPECT_EQ(divide_descriptors(40, wanted).branches, 0U);
}

TEST(SocketLimits, AreAtLeastOne) {
  for (const std::size_t descriptors : {0U, 16U, 32U, 33U, 40U}) {
    const SocketLimits limits = divide_descriptors(descriptors, kWanted);
    EXPECT_GE(limits.lines, 1U);
    EXPECT_GE(limits.connections, 1U);
    EXPECT_GE(limits.refusals, 4U);
  }
}

TEST(SocketLimits, LinesGetAtMostHalfOfFewDescriptors) {
  const SocketLimits limits = divide_descriptors(36 + 211, kWanted);
  EXPECT_EQ(limits.lines, 105U);
  EXPECT_EQ(limits.connections, 99U);
  EXPECT_EQ(limits.refusals, 6U);
  EXPECT_EQ(divide_descriptors(36 + 211, SocketLimits()).lines, 64U);
}

TEST(SocketLimits, OneAddressMayHaveEveryPlaceUnlessItIsLimited) {
  const auto remote = asio::ip::make_address("192.0.2.1");
  const auto local = asio::ip::make_address("127.0.0.1");
  const auto is_second_served = [](PeerCounts counts, const asio::ip::address& address) {
    const auto first = counts.take(address);
    return counts.take(address) != nullptr;
  };
  EXPECT_TRUE(is_second_served(peer_counts(0), remote));
  EXPECT_FALSE(is_second_served(peer_counts(0, 1), remote));
  EXPECT_TRUE(is_second_served(peer_counts(0, 1), local));
  EXPECT_FALSE(is_second_served(peer_counts(1), remote));
  EXPECT_FALSE(is_second_served(peer_counts(1), local));
}

}  // namespace
}  // namespace xr3
