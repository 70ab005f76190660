#include "cell/warning_limiter.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

ProblemNote note(std::string_view code, std::uint64_t offset) {
  return {code, "why", offset, {}, 1};
}

const ProblemNote& problem(const CellNote& note) { return std::get<ProblemNote>(note); }

TEST(WarningLimiter, ARunOfOneCodeIsOneNoteWithCountAndFirstOffset) {
  WarningLimiter limiter;
  EXPECT_TRUE(limiter.add(1, 0, note("unknown_byte", 7)).empty());
  EXPECT_TRUE(limiter.extends_run(1, 5, "unknown_byte"));
  EXPECT_TRUE(limiter.add(1, 5, note("unknown_byte", 9)).empty());
  const auto due = limiter.add(1, 6, note("no_such_joint", 10));
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(problem(due[0]).count, 3);
  EXPECT_EQ(problem(due[0]).offset, 7U);
  EXPECT_EQ(limiter.finish(1, 6).size(), 1U);
  EXPECT_TRUE(limiter.finish(1, 6).empty());
}

TEST(WarningLimiter, LinesDoNotShareRuns) {
  WarningLimiter limiter;
  limiter.add(1, 0, note("unknown_byte", 0));
  EXPECT_FALSE(limiter.extends_run(2, 0, "unknown_byte"));
  EXPECT_TRUE(limiter.finish(2, 0).empty());
}

TEST(WarningLimiter, HasALineFromItsFirstWarningUntilItCloses) {
  WarningLimiter limiter;
  EXPECT_FALSE(limiter.has_lines());
  limiter.add(1, 0, note("unknown_byte", 0));
  EXPECT_TRUE(limiter.has_lines());
  limiter.forget(1);
  EXPECT_FALSE(limiter.has_lines());
}

TEST(WarningLimiter, SummarizesNotesAboveSixtyFourASecond) {
  WarningLimiter limiter;
  std::size_t notes = 0;
  for (int i = 0; i < 100; ++i) {
    notes += limiter.add(1, i, note(i % 2 == 0 ? "unknown_byte" : "no_such_joint", 0)).size();
  }
  notes += limiter.finish(1, 100).size();
  EXPECT_EQ(notes, 64U);
  const auto due = limiter.add(1, 1000, note("unknown_byte", 0));
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(std::get<SuppressedNote>(due[0]).count, 36);
}

TEST(WarningLimiter, ARunAcrossTwoSecondsIsTwoNotes) {
  WarningLimiter limiter;
  limiter.add(1, 999, note("unknown_byte", 0));
  EXPECT_FALSE(limiter.extends_run(1, 1000, "unknown_byte"));
  EXPECT_EQ(limiter.add(1, 1000, note("unknown_byte", 1)).size(), 1U);
  EXPECT_EQ(limiter.finish(1, 1000).size(), 1U);
}

TEST(WarningLimiter, PendingNotesComeWithTheNextSecondOrTheClose) {
  for (const bool closes : {false, true}) {
    WarningLimiter limiter;
    for (int i = 0; i < 100; ++i)
      limiter.add(1, i, note(i % 2 == 0 ? "unknown_byte" : "no_such_joint", 0));
    limiter.finish(1, 100);
    EXPECT_TRUE(limiter.has_pending());
    EXPECT_TRUE(limiter.take_pending(999).empty());
    const auto words =
        closes ? limiter.forget(1) : std::vector{limiter.take_pending(1000).at(0).second};
    EXPECT_EQ(std::get<SuppressedNote>(words.at(0)).count, 36);
    EXPECT_FALSE(limiter.has_pending());
    EXPECT_TRUE(limiter.take_pending(2000).empty());
  }
}

}  // namespace
}  // namespace xr3
