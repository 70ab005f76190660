// A motor whose next count would move any joint past a limit stops, keeps its error counter, and
// can move the other way.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/motor.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::Rig;
using test::roomy_rhino;

struct EndCase {
  char label;
  Counts last;  ///< the count at which the motor stops
  bool upper;   ///< of the joint variable
  double limit;
};

constexpr EndCase kEnds[] = {
    {'F', 771, true, 175},           {'F', -771, false, -175}, {'E', 881, true, 10},
    {'E', -440, false, -140},        {'D', 925, false, -15},   {'D', -660, true, 165},
    {'C', 1101, false, -125},        {'C', -1101, true, 125},  {'B', 1152288, true, 360000},
    {'B', -1151712, false, -360000}, {'A', -16, true, 63.5},   {'A', 64, false, 0},
};

int sign(int value) { return value < 0 ? -1 : 1; }

TEST(Limits, EveryDriveStopsAtBothLimits) {
  for (const auto& [label, last, upper, limit] : kEnds) {
    Rig rig(roomy_rhino());
    const int outwards = sign(last);
    rig.stand_at({{label, last - 3 * outwards}});
    rig.move(label, 10 * outwards);
    rig.settle();
    EXPECT_EQ(rig.count(label), last) << label;
    EXPECT_EQ(rig.error(label), 7 * outwards) << label;
    EXPECT_EQ(rig.motor(label).blocked, Blocked::kLimit) << label;
    EXPECT_EQ(rig.motor(label).phase, 0) << label;
    EXPECT_EQ(rig.events_of<MotorBlocked>(),
              (std::vector<MotorBlocked>{
                  {label, Blocked::kLimit, label, upper, limit, last, 7 * outwards}}))
        << label;
  }
}

TEST(Limits, ABlockedMotorKeepsItsErrorCounter) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'F', 770}});
  rig.move('F', 5);
  rig.pass(1'000'000);
  EXPECT_EQ(rig.error('F'), 4);
  EXPECT_EQ(rig.events_of<MotorBlocked>().size(), 1U);
}

TEST(Limits, EveryDriveMovesAwayFromItsLimit) {
  for (const EndCase& end : kEnds) {
    Rig rig(roomy_rhino());
    rig.stand_at({{end.label, end.last}});
    rig.move(end.label, 10 * sign(end.last));
    EXPECT_EQ(rig.motor(end.label).blocked, Blocked::kLimit) << "reported at once";
    rig.move(end.label, -15 * sign(end.last));
    EXPECT_EQ(rig.motor(end.label).blocked, Blocked::kNo);
    rig.settle();
    EXPECT_EQ(rig.count(end.label), end.last - 5 * sign(end.last)) << end.label;
  }
}

TEST(Limits, AStopFreesTheMotor) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'F', 771}});
  rig.move('F', 10);
  rig.execute(Stop{'F'});
  EXPECT_EQ(rig.motor('F').blocked, Blocked::kNo);
  EXPECT_EQ(rig.error('F'), 0);
}

TEST(Limits, AMotorBeyondALimitOnlyMovesBack) {
  const ModelPtr model = roomy_rhino();
  State state = test::state_at(*model, {{'F', 800}});
  MotorState& base = state.motor(model->index_of('F'));
  base.error = 1;
  EXPECT_EQ(obstacle(*model, state, positions(*model, state.motors), 0), Blocked::kLimit);
  base.error = -11;
  EXPECT_EQ(obstacle(*model, state, positions(*model, state.motors), 0), Blocked::kNo);
}

struct CoupledCase {
  std::initializer_list<LabelledCount> from;
  char moved;
  int counts;
  Counts last;
  char by;
  bool upper;
  double limit;
};

TEST(Limits, AMotorStopsAtTheLimitOfACoupledJoint) {
  const CoupledCase cases[] = {
      {{{'E', 500}, {'D', 423}}, 'E', 10, 502, 'D', false, -15},
      {{{'E', -300}, {'D', -358}}, 'E', -10, -302, 'D', true, 165},
      {{{'D', 600}, {'C', -499}}, 'D', 10, 602, 'C', true, 125},
      {{{'D', -600}, {'C', 499}}, 'D', -10, -602, 'C', false, -125},
  };
  for (const CoupledCase& wanted : cases) {
    Rig rig(roomy_rhino());
    rig.stand_at(wanted.from);
    rig.move(wanted.moved, wanted.counts);
    rig.settle();
    const int left = 8 * sign(wanted.counts);
    EXPECT_EQ(rig.events_of<MotorBlocked>(),
              (std::vector<MotorBlocked>{{wanted.moved, Blocked::kLimit, wanted.by, wanted.upper,
                                          wanted.limit, wanted.last, left}}))
        << wanted.moved << " at " << rig.count(wanted.moved);
    EXPECT_EQ(rig.error(wanted.by), 0) << "that motor did not turn";
  }
}

TEST(Limits, AnotherJointCanFreeAMotor) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'D', 600}, {'C', -501}});
  rig.move('D', 100);
  rig.settle();
  EXPECT_EQ(rig.error('D'), 100);
  rig.move('C', 10);
  rig.settle();
  EXPECT_EQ(rig.count('C'), -491);
  EXPECT_EQ(rig.count('D'), 610) << "up to the new limit of the pitch";
  EXPECT_EQ(rig.error('D'), 90);
  rig.move('C', 100);
  rig.settle();
  EXPECT_EQ(rig.count('D'), 700);
}

TEST(Limits, AFreedMotorStartsACompleteCount) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'D', 600}, {'C', -501}});
  rig.execute(SetSpeed{'C', 100});
  rig.execute(SetSpeed{'D', 100});
  rig.move('D', 5);
  rig.move('C', 1);
  rig.pass(10);
  ASSERT_EQ(rig.count('C'), -500);
  EXPECT_EQ(rig.motor('D').blocked, Blocked::kNo);
  rig.pass(9);
  EXPECT_EQ(rig.count('D'), 600);
  rig.pass(1);
  EXPECT_EQ(rig.count('D'), 601);
}

// Counts of E and D are due in the same tick and there is room for one: the joint nearer to the
// base is first.
TEST(Limits, EachCountIsCheckedAgainstEarlierCountsOfTheTick) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'E', 400}, {'D', 524}});
  rig.execute(SetSpeed{'E', 100});
  rig.execute(SetSpeed{'D', 100});
  rig.move('D', 5);
  rig.move('E', 5);
  rig.pass(10);
  EXPECT_EQ(rig.count('E'), 401);
  EXPECT_EQ(rig.count('D'), 524);
  EXPECT_EQ(rig.motor('E').blocked, Blocked::kLimit);
  EXPECT_EQ(rig.motor('D').blocked, Blocked::kLimit);
}

TEST(Limits, AStuckMotorGivesTwoEqualReplies) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'A', -14}});
  rig.move('A', -20);
  rig.pass(200);
  const Reply first = rig.execute(QueryError{'A'});
  rig.pass(22);
  EXPECT_EQ(rig.execute(QueryError{'A'}), first);
  EXPECT_EQ(first, Reply(ErrorMagnitude{18}));
}

}  // namespace
}  // namespace xr3
