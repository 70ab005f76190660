#include "cell/line/transmitter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace xr3 {
namespace {

CharacterTime time_at(const char* settings) { return {*parse_serial_settings(settings), Rate{}}; }

TEST(Transmitter, CharactersOfARunShareTheirRounding) {
  Transmitter clock(time_at("9600-7e2"));
  clock.start(5'000);
  std::vector<Micros> dues;
  for (int i = 0; i < 4; ++i) {
    dues.push_back(clock.due());
    clock.complete(i < 3);
  }
  EXPECT_EQ(dues, (std::vector<Micros>{6'145, 7'291, 8'437, 9'583}));
  EXPECT_FALSE(clock.is_busy());
}

TEST(Transmitter, ARunAfterAPauseBeginsAnew) {
  Transmitter clock(time_at("9600-7e2"));
  clock.start(0);
  clock.complete(false);
  clock.start(10'000);
  EXPECT_EQ(clock.due(), 11'145);
  clock.stop();
  EXPECT_FALSE(clock.is_busy());
}

TEST(Transmitter, AnotherSpeedCountsFromTheCharacterUnderWay) {
  Transmitter clock(time_at("1000-8n1"));
  clock.start(0);
  clock.complete(true);
  EXPECT_EQ(clock.due(), 20'000);
  clock.set_time(time_at("10000-8n1"));
  EXPECT_EQ(clock.due(), 11'000);
  clock.set_time(time_at("10000-8n1"));
  EXPECT_EQ(clock.due(), 11'000);
}

}  // namespace
}  // namespace xr3
