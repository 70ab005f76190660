#include "server/lines/turn_peers.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

const asio::ip::address kOne = asio::ip::make_address("192.0.2.1");
const asio::ip::address kOther = asio::ip::make_address("192.0.2.2");

TEST(TurnPeers, LinesOfAnAddressAreOnePeer) {
  TurnPeers peers;
  const auto first = peers.at(&kOne);
  EXPECT_EQ(peers.at(&kOne), first);
  EXPECT_NE(peers.at(&kOther), first);
}

TEST(TurnPeers, ALineWithoutAnAddressIsAPeerOfItsOwn) {
  TurnPeers peers;
  const auto first = peers.at(nullptr);
  EXPECT_NE(peers.at(nullptr), first);
  EXPECT_EQ(peers.size(), 0U);
}

TEST(TurnPeers, APeerWithoutLinesIsNew) {
  TurnPeers peers;
  auto first = peers.at(&kOne);
  const std::weak_ptr<TurnQueue::Peer> ended = first;
  first.reset();
  EXPECT_TRUE(ended.expired());
  EXPECT_TRUE(peers.at(&kOne));
}

TEST(TurnPeers, AddressesWithoutLinesAreForgotten) {
  TurnPeers peers;
  const auto kept = peers.at(&kOne);
  for (std::uint32_t host = 1; host <= 10'000; ++host) {
    const asio::ip::address address = asio::ip::address_v4(0x0a00'0000U + host);
    peers.at(&address);
  }
  EXPECT_LE(peers.size(), 4U);
  EXPECT_EQ(peers.at(&kOne), kept);
}

}  // namespace
}  // namespace xr3
