#include "server/net/peer_counts.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace xr3 {
namespace {

TEST(PeerCounts, LimitsEachAddress) {
  const auto one = asio::ip::make_address("192.0.2.1");
  const auto other = asio::ip::make_address("192.0.2.2");
  PeerCounts counts(2);
  auto first = counts.take(one);
  const auto second = counts.take(one);
  EXPECT_TRUE(first && second);
  EXPECT_FALSE(counts.take(one));
  const auto its = counts.take(other);
  ASSERT_TRUE(its);
  EXPECT_EQ(*its, other);
  first.reset();
  EXPECT_TRUE(counts.take(one)) << "a place is free again";
}

TEST(PeerCounts, LimitsThisMachineSeparately) {
  const auto local = asio::ip::make_address("127.0.0.1");
  PeerCounts unlimited(1);
  std::vector<PeerCounts::Place> places;
  for (int i = 0; i < 100; ++i) places.push_back(unlimited.take(local));
  for (const auto& place : places) EXPECT_TRUE(place);
  PeerCounts limited(5, 1);
  const auto place = limited.take(local);
  EXPECT_TRUE(place);
  EXPECT_FALSE(limited.take(asio::ip::make_address("::1")) == nullptr) << "another address";
  EXPECT_FALSE(limited.take(local));
}

}  // namespace
}  // namespace xr3
