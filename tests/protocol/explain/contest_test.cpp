#include "protocol/explain/contest.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace xr3 {
namespace {

/// A cell's error counters, and what the observer says of the moves of its lines.
class Contests {
 public:
  /// Adds counts to a joint; returns the other line of the contest, 0 if there is none.
  LineId move(LineId line, Tick tick, char label, int counts) {
    std::int8_t& error = errors_.at(static_cast<std::size_t>(label - 'A'));
    error = static_cast<std::int8_t>(error + counts);
    const auto note = observer_.handle({0, tick, line, EventBody{MoveTaken{label, counts, error}}});
    if (note) EXPECT_EQ(note->label, label);
    return note ? note->other : 0;
  }
  void arrive(char label) { errors_.at(static_cast<std::size_t>(label - 'A')) = 0; }
  void emit(std::optional<LineId> line, Tick tick, CellNote note) {
    EXPECT_FALSE(observer_.handle({0, tick, line, std::move(note)}));
  }

 private:
  ContestObserver observer_;
  std::array<std::int8_t, 8> errors_{};
};

TEST(Contest, TwoLinesMoveOneJoint) {
  Contests contests;
  EXPECT_EQ(contests.move(1, 0, 'E', 50), 0U);
  EXPECT_EQ(contests.move(2, 100, 'E', 50), 1U);
}

TEST(Contest, OnceForTwoLinesAndAJoint) {
  Contests contests;
  contests.move(1, 0, 'E', 50);
  EXPECT_EQ(contests.move(2, 100, 'E', 5), 1U);
  EXPECT_EQ(contests.move(1, 200, 'E', 5), 0U);
  EXPECT_EQ(contests.move(2, 300, 'E', 5), 0U);
  EXPECT_EQ(contests.move(3, 400, 'E', 5), 2U) << "another pair";
  contests.move(1, 500, 'D', 50);
  EXPECT_EQ(contests.move(2, 600, 'D', 5), 1U) << "another joint";
}

TEST(Contest, AgainAfterOneOfTheLinesHasClosed) {
  Contests contests;
  contests.move(1, 0, 'E', 50);
  contests.move(2, 100, 'E', 5);
  contests.emit(1, 200, LineClosedNote{LineCloseReason::kClientClosed, 0, 0});
  EXPECT_EQ(contests.move(3, 300, 'E', 5), 2U);
  contests.emit(2, 400, LineClosedNote{LineCloseReason::kClientClosed, 0, 0});
  contests.move(1, 500, 'E', 5);
  EXPECT_EQ(contests.move(2, 600, 'E', 5), 1U) << "a line with the same number";
}

TEST(Contest, NotWithTheMoveOfAClosedLine) {
  Contests contests;
  contests.move(1, 0, 'E', 50);
  contests.emit(1, 100, LineClosedNote{LineCloseReason::kClientClosed, 0, 0});
  EXPECT_EQ(contests.move(2, 200, 'E', 5), 0U);
}

TEST(Contest, NotByOneLineOnDifferentJointsOrAfterTheJointHasArrived) {
  Contests contests;
  contests.move(1, 0, 'E', 50);
  EXPECT_EQ(contests.move(1, 100, 'E', 5), 0U) << "one line";
  EXPECT_EQ(contests.move(2, 100, 'D', 5), 0U) << "another joint";
  contests.arrive('E');
  EXPECT_EQ(contests.move(2, 200, 'E', 5), 0U) << "no counts to go";
  EXPECT_EQ(contests.move(1, 300, 'E', 0), 0U) << "a move of no count";
  EXPECT_EQ(contests.move(2, 400, 'E', 5), 0U) << "after a move of no count";
}

TEST(Contest, TheCounterMayWrap) {
  Contests contests;
  contests.move(1, 0, 'E', 127);
  EXPECT_EQ(contests.move(2, 100, 'E', 127), 1U);
  contests.move(1, 0, 'D', -128);
  EXPECT_EQ(contests.move(2, 100, 'D', -128), 1U);
}

TEST(Contest, TheOtherMoveIsAtMostTwoSecondsOld) {
  Contests contests;
  contests.move(1, 1000, 'E', 100);
  contests.move(1, 1000, 'D', 100);
  EXPECT_EQ(contests.move(2, 3000, 'E', 5), 1U);
  EXPECT_EQ(contests.move(2, 3001, 'D', 5), 0U);
}

TEST(Contest, AnEpochForgetsTheMoves) {
  Contests contests;
  contests.move(1, 5000, 'E', 50);
  contests.emit(std::nullopt, 100, EpochNote{"snapshot_load", 0, 5000});
  EXPECT_EQ(contests.move(2, 200, 'E', 5), 0U);
}

TEST(Contest, ItsMemoryIsBounded) {
  Contests contests;
  std::size_t told = 0;
  contests.move(1, 0, 'E', 1);
  for (LineId line = 2; line < 1000; ++line) told += contests.move(line, 0, 'E', 2) == 0 ? 0 : 1;
  EXPECT_EQ(told, ContestObserver::kMaxContests);
  contests.emit(1, 0, LineClosedNote{LineCloseReason::kClientClosed, 0, 0});
  EXPECT_NE(contests.move(1000, 0, 'E', 1), 0U) << "one place is free";
  EXPECT_EQ(contests.move(1001, 0, 'E', 1), 0U);
}

}  // namespace
}  // namespace xr3
