#include "core/invariants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using testing::StrEq;

RC_GTEST_PROP(Invariants, HoldAfterRandomMovesAndTicks, ()) {
  test::Rig rig;
  for (int i = *rc::gen::inRange(1, 30); i > 0; --i) {
    const char label = *rc::gen::element('A', 'B', 'C', 'D', 'E', 'F');
    rig.move(label, *rc::gen::inRange(-128, 128));
    rig.pass(*rc::gen::inRange(0, 4000));
    const char* broken = broken_invariant(rig.model(), rig.state());
    if (broken != nullptr) RC_FAIL(broken);
  }
}

struct Case {
  const char* broken;
  std::function<void(State&)> damage;
};

class BrokenInvariant : public testing::TestWithParam<Case> {};

TEST_P(BrokenInvariant, IsReportedByName) {
  const test::Rig rig;
  State state = rig.state();
  ASSERT_EQ(broken_invariant(rig.model(), state), nullptr);
  GetParam().damage(state);
  EXPECT_THAT(broken_invariant(rig.model(), state), StrEq(GetParam().broken));
}

const Case kCases[] = {
    {"a motor's speed is at least 1 count a second", [](State& s) { s.motor(0).speed = 0; }},
    {"a motor's phase is within 0...999", [](State& s) { s.motor(1).phase = 1000; }},
    {"the phase of a stopped motor is 0", [](State& s) { s.motor(1).phase = 5; }},
    {"a motor is blocked exactly where something obstructs it",
     [](State& s) { s.motor(2).blocked = Blocked::kLimit; }},
    {"a microswitch follows from its motor's count, unless it is stuck",
     [](State& s) { s.motor(0).switch_closed = !s.motor(0).switch_closed; }},
    {"without faults none is in force", [](State& s) { s.faults.now.next_stop = 5; }},
    {"the faults in force follow from the tick and their effects",
     [](State& s) { s.faults.all.emplace_back(); }},
    {"the number of blocks is bounded", [](State& s) { s.blocks.edit().resize(kMaxBlocks + 1); }},
    {"the tip is below the surface exactly where the state says so",
     [](State& s) { s.below_surface = true; }},
    {"the held block exists", [](State& s) { s.held = Held{}; }},
    {"the view vector is not zero",
     [](State& s) {
       s.display.view = {0, 0, 0};
     }},
    {"the view vector's components are within -9...9", [](State& s) { s.display.view.y = 10; }},
    {"the refresh period is within 1...255 half seconds",
     [](State& s) { s.display.period_half_s = 0; }},
    {"the status option is within 0...6", [](State& s) { s.display.status_option = 7; }},
    {"the tip path's oldest point exists", [](State& s) { s.tip_path.oldest = 1; }},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenInvariant, testing::ValuesIn(kCases));

}  // namespace
}  // namespace xr3
