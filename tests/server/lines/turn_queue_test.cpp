#include "server/lines/turn_queue.hpp"

#include <gtest/gtest.h>

#include "server/lines/session.hpp"

namespace xr3 {
namespace {

constexpr std::uint64_t kLight = 200;
constexpr std::uint64_t kImages = 25'000;
constexpr std::uint64_t kEndless = 100'000;

/// A queue for lines of one peer.
struct TurnsOfAPeer : TurnQueue {
  void add(SessionNumber line, std::uint64_t load) { TurnQueue::add(line, load, peer); }
  Peer peer;
};

std::vector<SessionNumber> take_all(TurnQueue& turns) {
  std::vector<SessionNumber> lines;
  while (!turns.empty()) lines.push_back(turns.take_lightest());
  return lines;
}

TEST(TurnQueue, LightLinesGoFirst) {
  TurnsOfAPeer turns;
  turns.add(1, kEndless);
  turns.add(2, kImages);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_lightest(), 3U);
  EXPECT_EQ(turns.take_lightest(), 2U);
  EXPECT_EQ(turns.take_lightest(), 1U);
  EXPECT_TRUE(turns.empty());
}

TEST(TurnQueue, NewLinesGoAfterLinesThatOnlyAsk) {
  TurnsOfAPeer turns;
  turns.add(1, LineSession::kNewLoad);
  turns.add(2, kLight);
  EXPECT_EQ(turns.take_lightest(), 2U);
}

TEST(TurnQueue, LinesOfAboutTheSameLoadTakeTurns) {
  TurnsOfAPeer turns;
  for (const SessionNumber line : {7U, 5U, 6U}) turns.add(line, kLight + line);
  EXPECT_EQ(turns.take_lightest(), 7U);
  turns.add(7, kLight);
  EXPECT_EQ(turns.take_lightest(), 5U);
  EXPECT_EQ(turns.take_lightest(), 6U);
  EXPECT_EQ(turns.take_lightest(), 7U);
}

TEST(TurnQueue, ALineThatAsksOnceAMillisecondStaysLightAfterAWaitOf64) {
  constexpr std::uint64_t kAfterAWait = 64 * 204;
  TurnsOfAPeer turns;
  turns.add(1, kAfterAWait);
  turns.add(2, kLight);
  EXPECT_EQ(turns.take_lightest(), 1U);
}

TEST(TurnQueue, HeavyLinesAreNotForgotten) {
  TurnsOfAPeer turns;
  turns.add(1, kEndless);
  turns.add(2, kEndless);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_first_of_each(), (std::vector<SessionNumber>{1, 3}));
  EXPECT_EQ(turns.take_first_of_each(), std::vector<SessionNumber>{2});
  EXPECT_TRUE(turns.take_first_of_each().empty());
}

TEST(TurnQueue, NewLinesAreNotForgottenBesideLightAndHeavyOnes) {
  TurnsOfAPeer turns;
  turns.add(1, kEndless);
  turns.add(2, LineSession::kNewLoad);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_first_of_each(), (std::vector<SessionNumber>{1, 2, 3}));
}

TEST(TurnQueue, ALineWaitsOnce) {
  TurnsOfAPeer turns;
  turns.add(1, kLight);
  turns.add(1, kEndless);
  EXPECT_TRUE(turns.contains(1));
  EXPECT_EQ(turns.take_lightest(), 1U);
  EXPECT_FALSE(turns.contains(1));
  EXPECT_TRUE(turns.empty());
}

TEST(TurnQueue, ALineIsNextIfNoLighterOneOrEqualOneWaits) {
  TurnsOfAPeer turns;
  EXPECT_TRUE(turns.is_next(kEndless));
  turns.add(1, kImages);
  EXPECT_TRUE(turns.is_next(kLight));
  EXPECT_FALSE(turns.is_next(kImages));
  EXPECT_FALSE(turns.is_next(kEndless));
}

TEST(TurnQueue, PeersTakeTurnsHoweverManyLinesTheyHave) {
  TurnQueue turns;
  TurnQueue::Peer crowd;
  TurnQueue::Peer pair;
  TurnQueue::Peer single;
  for (SessionNumber line = 1; line <= 4; ++line) turns.add(line, kLight, crowd);
  turns.add(11, kLight, pair);
  turns.add(12, kLight, pair);
  turns.add(21, kLight, single);
  EXPECT_EQ(take_all(turns), (std::vector<SessionNumber>{1, 11, 21, 2, 12, 3, 4}));
}

TEST(TurnQueue, ALineThatComesLateWaitsForOneOfEachOtherPeer) {
  TurnQueue turns;
  TurnQueue::Peer crowd;
  TurnQueue::Peer single;
  constexpr SessionNumber kCrowd = 1000;
  for (SessionNumber line = 1; line <= kCrowd; ++line) turns.add(line, kLight, crowd);
  for (SessionNumber line = 1; line <= kCrowd; ++line) {
    if (line % 100 == 0) {
      turns.add(kCrowd + 1, kLight, single);
      EXPECT_EQ(turns.take_lightest(), kCrowd + 1);
    }
    EXPECT_EQ(turns.take_lightest(), line);
  }
}

TEST(TurnQueue, APeerThatWasAwayHasNoMoreTurnsThanTheOthers) {
  TurnQueue turns;
  TurnQueue::Peer busy;
  TurnQueue::Peer away;
  for (SessionNumber turn = 0; turn < 100; ++turn) {
    turns.add(1, kLight, busy);
    turns.take_lightest();
  }
  for (const SessionNumber line : {1U, 2U, 3U}) turns.add(line, kLight, busy);
  for (const SessionNumber line : {11U, 12U, 13U}) turns.add(line, kLight, away);
  EXPECT_EQ(take_all(turns), (std::vector<SessionNumber>{11, 1, 12, 2, 13, 3}));
}

TEST(TurnQueue, ALightLineGoesBeforeHeavyOnesOfOtherPeers) {
  TurnQueue turns;
  TurnQueue::Peer light;
  TurnQueue::Peer heavy;
  turns.add(1, kEndless, heavy);
  for (const SessionNumber line : {2U, 3U, 4U}) turns.add(line, kLight, light);
  EXPECT_EQ(take_all(turns), (std::vector<SessionNumber>{2, 3, 4, 1}));
}

}  // namespace
}  // namespace xr3
