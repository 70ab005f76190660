#include "protocol/line/line_speed.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace xr3 {
namespace {

constexpr std::int64_t kMillion = 1'000'000;

Micros time_of(const char* settings, std::int64_t count, std::int64_t factor = kMillion) {
  return CharacterTime(*parse_serial_settings(settings), Rate{factor}).of(count);
}

TEST(LineSpeed, ACharacterHasStartDataParityAndStopBits) {
  EXPECT_EQ(time_of("9600-7e2", 1), 1145);  // 11 bits
  EXPECT_EQ(time_of("9600-8n1", 1), 1041);  // 10 bits
  EXPECT_EQ(time_of("1000-8n1", 1), 10'000);
  EXPECT_EQ(time_of("1000-7o1", 1), 10'000);
  EXPECT_EQ(time_of("1000-5n1.5", 1), 7'500);
  EXPECT_EQ(time_of("1000-8m2", 1), 12'000);
  EXPECT_EQ(time_of("1000", 1), 11'000) << "a frame that is not known";
}

TEST(LineSpeed, ManyCharactersDoNotDrift) {
  EXPECT_EQ(time_of("9600-7e2", 200), 229'166);
  EXPECT_EQ(time_of("9600-7e2", 9600), 11 * kMillion);
  EXPECT_EQ(time_of("9600-7e2", 9600 * kMillion), 11 * kMillion * kMillion);
}

TEST(LineSpeed, AFactorMakesItFasterOrSlower) {
  EXPECT_EQ(time_of("1000-8n1", 1, 10 * kMillion), 1'000);
  EXPECT_EQ(time_of("1000-8n1", 1, kMillion / 1000), 10 * kMillion);
  EXPECT_EQ(time_of("4294967295-8n1", 1), 0);
  EXPECT_EQ(time_of("1-8e2", kMillion), 12 * kMillion * kMillion);
}

TEST(LineSpeed, ACharacterIsRoundedToTheNearestMicrosecond) {
  const auto rounded = [](const char* settings, std::int64_t factor) {
    return CharacterTime(*parse_serial_settings(settings), Rate{factor}).rounded();
  };
  EXPECT_EQ(rounded("9600-7e2", 1'000'000), 1'146) << "1145.83";
  EXPECT_EQ(rounded("300-8n1", 1'000'000), 33'333) << "33333.33";
  EXPECT_EQ(rounded("4000000-8n1", 1'000'000), 3) << "2.5";
}

}  // namespace
}  // namespace xr3
