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
  EXPECT_EQ(limits.lines, 998U);
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

TEST(SocketLimits, DivideInProportion) {
  const SocketLimits limits = divide_descriptors(36 + 211, kWanted);
  EXPECT_EQ(limits.lines, 102U);
  EXPECT_EQ(limits.connections, 102U);
  EXPECT_EQ(limits.refusals, 6U);
}

}  // namespace
}  // namespace xr3
