// The protected region and the work surface: their limits, and what a stall undoes and allows.
#include "core/stall.hpp"

#include <gtest/gtest.h>

#include "core/kinematics.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::positions_at;
using test::rhino;
using test::Rig;

struct RegionCase {
  PointUm tip;
  bool inside;
};

// Radius 100 mm, height 340 mm.
constexpr RegionCase kRegion[] = {
    {{0, 0, 0}, true},
    {{99'999, 0, 339'999}, true},
    {{100'000, 0, 339'999}, false},
    {{99'999, 0, 340'000}, false},
    {{-99'999, 0, 0}, true},
    {{0, -100'000, 0}, false},
    {{60'000, 80'000, 100}, false},
    {{60'000, 79'999, 100}, true},
    {{59'999, 80'000, 100}, true},
    {{-60'001, -80'000, 100}, false},
    {{0, 0, -50'000}, true},
};

TEST(Stall, TheRegionIsExactToTheMicrometre) {
  for (const auto& [tip, inside] : kRegion) {
    EXPECT_EQ(is_in_protected_region(*rhino(), {}, tip), inside)
        << tip.x << " " << tip.y << " " << tip.z;
  }
}

TEST(Stall, ARegionNeedsRadiusAndHeight) {
  EXPECT_FALSE(is_in_protected_region(*test::roomy_rhino(), {}, {0, 0, -1}));
  EXPECT_FALSE(is_in_protected_region(*test::roomy_rhino(), {}, {0, 0, 0}));
}

// Leaning the upper arm back (E-) takes the tip into the region from the front.
Counts last_safe_shoulder() {
  Counts e = 0;
  const auto is_inside = [](Counts count) {
    const Positions at = positions_at(*rhino(), {{'E', count}});
    return is_in_protected_region(*rhino(), at, tool_tip(*rhino(), at));
  };
  while (!is_inside(e)) --e;
  return e + 1;
}

// Counts of base, shoulder and jaws are due in the same tick, and the shoulder would enter the
// region.
Rig about_to_stall() {
  Rig rig;
  rig.stand_at({{'E', last_safe_shoulder()}});
  for (const char label : {'F', 'E', 'A'}) {
    rig.execute(SetSpeed{label, 100});
    rig.move(label, -5);
  }
  rig.pass(9);
  rig.simulation.take_events();
  return rig;
}

TEST(Stall, ATickThatWouldEnterTheRegionIsUndone) {
  Rig rig = about_to_stall();
  State wanted = rig.state();
  wanted.tick += 1;
  wanted.stall = Stall::kProtectedRegion;
  rig.pass(1);
  EXPECT_EQ(rig.state(), wanted);
  EXPECT_EQ(rig.simulation.events(), (Events{{wanted.tick, Stalled{Stall::kProtectedRegion}}}));
}

TEST(Stall, InAStallNothingMovesAndTimeGoesOn) {
  Rig rig = about_to_stall();
  rig.pass(1);
  State wanted = rig.state();
  rig.pass(1'000'000);
  wanted.tick += 1'000'000;
  EXPECT_EQ(rig.state(), wanted);
  EXPECT_TRUE(rig.simulation.is_at_rest());
}

TEST(Stall, InAStallCommandsChangeCountersAndInquiriesAnswer) {
  Rig rig = about_to_stall();
  rig.pass(1);
  const Counts shoulder = rig.count('E');
  rig.move('E', 25);
  EXPECT_EQ(rig.execute(QuerySignedError{'E'}), Reply(SignedError{20}));
  EXPECT_EQ(rig.execute(QueryError{'F'}), Reply(ErrorMagnitude{5}));
  rig.execute(Stop{'F'});
  EXPECT_EQ(rig.error('F'), 0);
  EXPECT_TRUE(std::get<SwitchBits>(rig.execute(QuerySwitchesI{})).closed & 4U);
  rig.pass(5000);
  EXPECT_EQ(rig.count('E'), shoulder)
      << "it is stalled although the move leads away from the region";
}

TEST(Stall, AStopInAStallClearsTheBlockedMark) {
  Rig rig;
  rig.stand_at({{'E', last_safe_shoulder()}, {'F', 771}});
  rig.move('F', 5);
  rig.move('E', -5);
  rig.settle();
  ASSERT_EQ(rig.state().stall, Stall::kProtectedRegion);
  ASSERT_EQ(rig.motor('F').blocked, Blocked::kLimit);
  rig.execute(Stop{'F'});
  EXPECT_EQ(rig.motor('F').blocked, Blocked::kNo);
}

TEST(Stall, OnlySoftHomeEndsAStall) {
  Rig rig = about_to_stall();
  rig.pass(1);
  for (const Command& command : {Command{ControllerReset{}}, Command{Stop{'E'}},
                                 Command{ToggleSimulator{}}, Command{Move{'E', 100}}}) {
    rig.execute(command);
    EXPECT_EQ(rig.state().stall, Stall::kProtectedRegion);
  }
  rig.execute(SoftHome{});
  EXPECT_EQ(rig.state().stall, Stall::kNo);
  rig.move('E', 5);
  rig.settle();
  EXPECT_EQ(rig.count('E'), 5);
}

// --- The work surface. At home the tip is 320.7 mm up; the shoulder lowers it.

ModelPtr with_surface(Micrometres height, bool stalls) {
  Workcell workcell = test::bare_workcell();
  workcell.work_surface_um = height;
  workcell.surface_stalls = stalls;
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper);
}

std::vector<Warning> surface_warnings(const Rig& rig) {
  std::vector<Warning> warnings;
  for (const Warning& warning : rig.events_of<Warning>()) {
    if (warning.code == WarningCode::kBelowSurface) warnings.push_back(warning);
  }
  return warnings;
}

TEST(Stall, ATipOnTheSurfaceIsNotBelowIt) {
  const ModelPtr model = with_surface(300'000, false);
  EXPECT_TRUE(is_below_surface(*model, {200'000, 0, 299'999}));
  EXPECT_FALSE(is_below_surface(*model, {200'000, 0, 300'000}));
}

TEST(Stall, PassingBelowTheSurfaceWarnsOncePerCrossing) {
  Rig rig(with_surface(300'000, false));
  rig.travel('E', 300);
  EXPECT_EQ(rig.count('E'), 300);
  EXPECT_TRUE(rig.state().below_surface);
  EXPECT_EQ(surface_warnings(rig).size(), 1U);
  rig.travel('E', -300);
  EXPECT_FALSE(rig.state().below_surface);
  EXPECT_EQ(surface_warnings(rig).size(), 1U) << "no event when it comes up again";
  rig.travel('E', 300);
  EXPECT_EQ(surface_warnings(rig).size(), 2U);
}

TEST(Stall, SurfaceStallsStopTheRobotAtTheSurface) {
  Rig rig(with_surface(300'000, true));
  rig.travel('E', 300);
  EXPECT_EQ(rig.state().stall, Stall::kWorkSurface);
  EXPECT_EQ(rig.events_of<Stalled>().front(), Stalled{Stall::kWorkSurface});
  EXPECT_TRUE(surface_warnings(rig).empty());
  const PointUm tip = tool_tip(rig.model(), positions(rig.model(), rig.state().motors));
  EXPECT_GE(tip.z, 300'000);
  EXPECT_LT(tip.z, 300'500) << "it went as far as it could";
}

TEST(Stall, ATipThatStartsBelowTheSurfaceMoves) {
  Rig rig(with_surface(400'000, true));
  EXPECT_TRUE(rig.state().below_surface);
  rig.travel('E', 50);
  EXPECT_EQ(rig.count('E'), 50);
  EXPECT_EQ(rig.state().stall, Stall::kNo);
}

}  // namespace
}  // namespace xr3
