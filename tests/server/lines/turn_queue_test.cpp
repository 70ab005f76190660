#include "server/lines/turn_queue.hpp"

#include <gtest/gtest.h>

#include "server/lines/session.hpp"

namespace xr3 {
namespace {

constexpr std::uint64_t kLight = 200;
constexpr std::uint64_t kImages = 25'000;
constexpr std::uint64_t kEndless = 100'000;

TEST(TurnQueue, LightLinesGoFirst) {
  TurnQueue turns;
  turns.add(1, kEndless);
  turns.add(2, kImages);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_lightest(), 3U);
  EXPECT_EQ(turns.take_lightest(), 2U);
  EXPECT_EQ(turns.take_lightest(), 1U);
  EXPECT_TRUE(turns.empty());
}

TEST(TurnQueue, NewLinesGoAfterLinesThatOnlyAsk) {
  TurnQueue turns;
  turns.add(1, LineSession::kNewLoad);
  turns.add(2, kLight);
  EXPECT_EQ(turns.take_lightest(), 2U);
}

TEST(TurnQueue, LinesOfAboutTheSameLoadTakeTurns) {
  TurnQueue turns;
  for (const SessionNumber line : {7U, 5U, 6U}) turns.add(line, kLight + line);
  EXPECT_EQ(turns.take_lightest(), 7U);
  turns.add(7, kLight);
  EXPECT_EQ(turns.take_lightest(), 5U);
  EXPECT_EQ(turns.take_lightest(), 6U);
  EXPECT_EQ(turns.take_lightest(), 7U);
}

TEST(TurnQueue, ALineThatAsksOnceAMillisecondStaysLightAfterAWaitOf64) {
  constexpr std::uint64_t kAfterAWait = 64 * 204;
  TurnQueue turns;
  turns.add(1, kAfterAWait);
  turns.add(2, kLight);
  EXPECT_EQ(turns.take_lightest(), 1U);
}

TEST(TurnQueue, HeavyLinesAreNotForgotten) {
  TurnQueue turns;
  turns.add(1, kEndless);
  turns.add(2, kEndless);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_first_of_each(), (std::vector<SessionNumber>{1, 3}));
  EXPECT_EQ(turns.take_first_of_each(), std::vector<SessionNumber>{2});
  EXPECT_TRUE(turns.take_first_of_each().empty());
}

TEST(TurnQueue, NewLinesAreNotForgottenBesideLightAndHeavyOnes) {
  TurnQueue turns;
  turns.add(1, kEndless);
  turns.add(2, LineSession::kNewLoad);
  turns.add(3, kLight);
  EXPECT_EQ(turns.take_first_of_each(), (std::vector<SessionNumber>{1, 2, 3}));
}

TEST(TurnQueue, ALineWaitsOnce) {
  TurnQueue turns;
  turns.add(1, kLight);
  turns.add(1, kEndless);
  EXPECT_TRUE(turns.contains(1));
  EXPECT_EQ(turns.take_lightest(), 1U);
  EXPECT_FALSE(turns.contains(1));
  EXPECT_TRUE(turns.empty());
}

TEST(TurnQueue, ALineIsNextIfNoLighterOneOrEqualOneWaits) {
  TurnQueue turns;
  EXPECT_TRUE(turns.is_next(kEndless));
  turns.add(1, kImages);
  EXPECT_TRUE(turns.is_next(kLight));
  EXPECT_FALSE(turns.is_next(kImages));
  EXPECT_FALSE(turns.is_next(kEndless));
}

}  // namespace
}  // namespace xr3
