// Rings grow as they are filled, and share a budget of memory.
#include "protocol/monitor/byte_budget.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "protocol/monitor/feed.hpp"

namespace xr3::monitor {
namespace {

Message number_text(const int& value, std::int64_t seq) {
  return std::make_shared<const std::string>(std::to_string(seq) + ":" + std::to_string(value));
}

constexpr std::size_t kMost = 256;

Ring<int> ring(ByteBudget* budget = nullptr) { return Ring<int>(kMost, number_text, budget); }

void fill(Ring<int>& ring, int count) {
  for (int i = 0; i < count; ++i) ring.push() = static_cast<int>(ring.next());
}

/// Expects that the ring has its latest messages, with the right values.
void expect_sound(Ring<int>& ring) {
  for (std::int64_t seq = ring.first(); seq < ring.next(); ++seq)
    EXPECT_EQ(*ring.at(seq), std::to_string(seq) + ":" + std::to_string(seq));
  EXPECT_LE(static_cast<std::size_t>(ring.next() - ring.first()), ring.capacity());
}

TEST(Ring, AnEmptyRingNeedsNoMemory) { EXPECT_EQ(ring().capacity(), 0U); }

TEST(Ring, GrowsToItsCapacityAndThenOverwrites) {
  Ring<int> all = ring();
  std::vector<std::size_t> capacities;
  for (int i = 0; i < 600; ++i) {
    fill(all, 1);
    if (capacities.empty() || capacities.back() != all.capacity())
      capacities.push_back(all.capacity());
    if (i % 50 == 0) expect_sound(all);
  }
  EXPECT_EQ(capacities, (std::vector<std::size_t>{16, 32, 64, 128, 256}));
  EXPECT_EQ(all.first(), 601 - 256);
  expect_sound(all);
}

// Moving the messages of a large ring would take milliseconds.
TEST(Ring, MessagesStayWhereTheyAreWhenItGrows) {
  Ring<int> all = ring();
  const int* first = &all.push();
  fill(all, kMost - 1);
  EXPECT_EQ(all.capacity(), kMost);
  EXPECT_EQ(&all.value_at(1), first);
}

TEST(ByteBudget, TheLargestRingGivesItsOldestMessages) {
  ByteBudget measure(1'000'000);
  std::size_t one_slot = 0;
  {
    Ring<int> measured = ring(&measure);
    fill(measured, 1);
    one_slot = measure.used_bytes() / measured.capacity();
  }
  EXPECT_EQ(measure.used_bytes(), 0U) << "a destroyed ring gives its memory back";
  ByteBudget budget(one_slot * 256);
  Ring<int> greedy = ring(&budget);
  fill(greedy, 256);
  EXPECT_EQ(greedy.capacity(), 256U);
  Ring<int> late = ring(&budget);
  fill(late, 100);
  EXPECT_EQ(greedy.capacity(), 128U);
  EXPECT_EQ(late.capacity(), 128U);
  EXPECT_EQ(greedy.first(), 257 - 128) << "the oldest have gone";
  expect_sound(greedy);
  expect_sound(late);
  fill(late, 200);
  EXPECT_EQ(late.capacity(), 128U) << "equal rings take nothing from each other";
  fill(greedy, 200);
  expect_sound(greedy);
  expect_sound(late);
  EXPECT_EQ(budget.used_bytes(), one_slot * 256);
}

TEST(ByteBudget, EveryRingHasAFewPlaces) {
  ByteBudget none(0);
  std::vector<std::unique_ptr<Ring<int>>> rings;
  for (int i = 0; i < 3; ++i) {
    rings.push_back(std::make_unique<Ring<int>>(kMost, number_text, &none));
    fill(*rings.back(), 100);
    EXPECT_EQ(rings.back()->capacity(), 16U);
    expect_sound(*rings.back());
  }
  rings.clear();
  EXPECT_EQ(none.used_bytes(), 0U);
}

TEST(ByteBudget, SharesWhatThereIs) {
  ByteBudget budget(64 * 1024);
  std::vector<std::unique_ptr<Ring<int>>> rings;
  for (int i = 0; i < 40; ++i) {
    rings.push_back(std::make_unique<Ring<int>>(kMost, number_text, &budget));
    fill(*rings.back(), 300);
    expect_sound(*rings.back());
  }
  EXPECT_LE(budget.used_bytes(), 64U * 1024);
  for (const auto& each : rings) {
    EXPECT_GE(each->capacity(), 16U);
    expect_sound(*each);
  }
}

}  // namespace
}  // namespace xr3::monitor
