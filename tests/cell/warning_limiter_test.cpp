#include "cell/warning_limiter.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

ProblemNote note(std::string_view code, std::uint64_t offset) {
  return {code, "why", offset, {}, 1};
}

const ProblemNote& problem(const CellNote& note) { return std::get<ProblemNote>(note); }

TEST(WarningGate, ARunOfOneCodeIsOneNoteWithItsCountAndFirstOffset) {
  WarningGate gate;
  EXPECT_TRUE(gate.take(1, 0, note("unknown_byte", 7)).empty());
  EXPECT_TRUE(gate.extends_run(1, 5, "unknown_byte"));
  EXPECT_TRUE(gate.take(1, 5, note("unknown_byte", 9)).empty());
  const auto due = gate.take(1, 6, note("no_such_joint", 10));
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(problem(due[0]).count, 3);
  EXPECT_EQ(problem(due[0]).offset, 7U);
  EXPECT_EQ(gate.finish(1, 6).size(), 1U);
  EXPECT_TRUE(gate.finish(1, 6).empty());
}

TEST(WarningGate, LinesDoNotShareRuns) {
  WarningGate gate;
  gate.take(1, 0, note("unknown_byte", 0));
  EXPECT_FALSE(gate.extends_run(2, 0, "unknown_byte"));
  EXPECT_TRUE(gate.finish(2, 0).empty());
}

TEST(WarningGate, AfterSixtyFourNotesASecondOneSaysHowManyWereLeftOut) {
  WarningGate gate;
  std::size_t told = 0;
  for (int i = 0; i < 100; ++i) {
    told += gate.take(1, i, note(i % 2 == 0 ? "unknown_byte" : "no_such_joint", 0)).size();
  }
  told += gate.finish(1, 100).size();
  EXPECT_EQ(told, 64U);
  const auto due = gate.take(1, 1000, note("unknown_byte", 0));
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(std::get<SuppressedNote>(due[0]).count, 36);
}

TEST(WarningGate, ARunThatCrossesASecondIsTwoNotes) {
  WarningGate gate;
  gate.take(1, 999, note("unknown_byte", 0));
  EXPECT_FALSE(gate.extends_run(1, 1000, "unknown_byte"));
  EXPECT_EQ(gate.take(1, 1000, note("unknown_byte", 1)).size(), 1U);
  EXPECT_EQ(gate.finish(1, 1000).size(), 1U);
}

TEST(WarningGate, WhatIsOwedComesWithTheNextSecondOrWhenTheLineCloses) {
  for (const bool closes : {false, true}) {
    WarningGate gate;
    for (int i = 0; i < 100; ++i)
      gate.take(1, i, note(i % 2 == 0 ? "unknown_byte" : "no_such_joint", 0));
    gate.finish(1, 100);
    EXPECT_TRUE(gate.owes_words());
    EXPECT_TRUE(gate.words_owed(999).empty());
    const auto words = closes ? gate.forget(1) : std::vector{gate.words_owed(1000).at(0).second};
    EXPECT_EQ(std::get<SuppressedNote>(words.at(0)).count, 36);
    EXPECT_FALSE(gate.owes_words());
    EXPECT_TRUE(gate.words_owed(2000).empty());
  }
}

}  // namespace
}  // namespace xr3
