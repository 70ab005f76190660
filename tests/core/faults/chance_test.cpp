// Chance as a hash: known values, so that a run of today can be repeated in years, and frequencies.
#include "core/faults/chance.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

// FNV-1a of eight zero bytes and "a", and splitmix64 of seed 0, computed apart from this program.
TEST(Chance, HasKnownValues) {
  EXPECT_EQ(salt_of(0, "a"), 0xE604613A248FF1ACU);
  EXPECT_EQ(salt_of(0x0807060504030201, "lost"), 0xDAA98B16A647B643U);
  EXPECT_EQ(mixed(0x9E3779B97F4A7C15), 0xE220A8397B1DCDAFU);
  EXPECT_EQ(chance_hash(1, 2, 3), 0xEB3AA0CE549FEC8CU);
}

TEST(Chance, ACertainThingHappensAndOneInABillionHardlyEver) {
  int rare = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    EXPECT_TRUE(happens(chance_hash(5, 1, i), kCertain));
    rare += happens(chance_hash(5, 1, i), 1) ? 1 : 0;
  }
  EXPECT_EQ(rare, 0);
}

TEST(Chance, ThingsHappenAsOftenAsTheyShould) {
  for (const std::uint32_t percent : {1U, 10U, 50U, 90U}) {
    int count = 0;
    for (std::uint64_t i = 0; i < 100'000; ++i)
      count += happens(chance_hash(salt_of(7, "x"), i % 3, i), percent * (kCertain / 100)) ? 1 : 0;
    EXPECT_NEAR(count, static_cast<int>(percent) * 1000, 500) << percent;
  }
}

}  // namespace
}  // namespace xr3
