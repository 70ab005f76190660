// The facts of runs of a cell, by each clock.
#include "cell/judge/run_observer.hpp"

#include <gtest/gtest.h>

#include "core/kinematics.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

ModelPtr observed_model() {
  static const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  return model;
}

/// A cell with the byte clock, an open line and an observer.
struct ObservedCell {
  explicit ObservedCell(std::vector<Goal> all = {})
      : goals{"", std::move(all)}, cell("main", observed_model(), SimClock::bytes()) {
    cell.set_byte_clock({});
    observer.emplace(cell, goals);
    cell.apply(LineOpened{"test"}, 0);
  }

  void send(std::string_view bytes) { cell.apply(BytesIn{1, bytes}, 0); }
  void run_to_rest() {
    while (!cell.is_at_rest()) send("I");
  }

  GoalList goals;
  Cell cell;
  std::optional<RunObserver> observer;
};

/// Counts that bring the jaws to the red block and close them.
void pick_red(ObservedCell& run) {
  for (const char* move : {"A-16\r", "E+121\rD-125\r", "E+121\rD-125\r", "E+121\rD-125\r",
                           "E+86\rD-125\r", "D-125\r", "A+90\r"}) {
    run.send(move);
    run.run_to_rest();
  }
}

TEST(RunObserver, TheLastCountAndTheBytes) {
  ObservedCell run;
  run.send("E+50\r");
  run.run_to_rest();
  const RunFacts facts = run.observer->facts();
  EXPECT_EQ(facts.bytes, run.cell.counters().bytes_in);
  EXPECT_NEAR(static_cast<double>(facts.last_count_tick), 50.0 / 110 * 1000, 20);
  EXPECT_LE(facts.last_count_tick, run.cell.state().tick);
  EXPECT_EQ(facts.problem_count, 0U);
}

TEST(RunObserver, TheFirstUseOfTheSoftHome) {
  ObservedCell run;
  run.send("E+50\r");
  run.run_to_rest();
  EXPECT_FALSE(run.observer->facts().soft_home_tick);
  const Tick before = run.cell.state().tick;
  run.send("A$");
  const auto first = run.observer->facts().soft_home_tick;
  ASSERT_TRUE(first);
  EXPECT_GE(*first, before);
  run.send("E+50\r");
  run.run_to_rest();
  run.send("A$");
  EXPECT_EQ(run.observer->facts().soft_home_tick, first);
}

TEST(RunObserver, TheFirstWarningHasTheSameTickHoweverTheBytesArrive) {
  const std::string bytes = "E?y?E?E?y?E?";
  ObservedCell whole;
  whole.send(bytes);
  ObservedCell pieces;
  for (const char byte : bytes) pieces.send({&byte, 1});
  for (ObservedCell* run : {&whole, &pieces})
    run->cell.apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  ASSERT_FALSE(whole.observer->facts().problems.empty());
  EXPECT_EQ(whole.observer->facts().problems[0].tick, pieces.observer->facts().problems[0].tick);
  EXPECT_EQ(whole.observer->facts().problem_count, pieces.observer->facts().problem_count);
}

TEST(RunObserver, ThePathOfTheTip) {
  ObservedCell run;
  const auto tip = [&] {
    return tool_tip(run.cell.model(), positions(run.cell.model(), run.cell.state().motors));
  };
  const PointUm begin = tip();
  run.send("F+90\r");
  run.run_to_rest();
  const double angle = 90 * 0.2269 * kPi / 180;
  const double radius = static_cast<double>(begin.x);
  EXPECT_NEAR(static_cast<double>(run.observer->facts().tip_path_um), radius * angle,
              radius * 0.01);
}

TEST(RunObserver, GraspsAndReleasesInOrder) {
  ObservedCell run(
      {{1, "", goal::Untouched{{"red"}, 1'000}}, {1, "", goal::Untouched{{"blue"}, 1'000}}});
  pick_red(run);
  ASSERT_TRUE(run.cell.state().held);
  EXPECT_FALSE(run.observer->facts().breaches[0]) << "grasped, but not moved";
  run.send("E-60\r");
  run.run_to_rest();
  run.send("A-60\r");
  run.run_to_rest();
  const RunFacts facts = run.observer->facts();
  EXPECT_EQ(facts.happenings, (std::vector<std::string>{"grasped red", "released red"}));
  ASSERT_TRUE(facts.breaches[0]);
  EXPECT_EQ(facts.breaches[0]->block, "red");
  EXPECT_FALSE(facts.breaches[1]);
  ASSERT_EQ(facts.problems.size(), 1U);
  EXPECT_EQ(facts.problems[0].code, "released_in_air");
}

TEST(RunObserver, ABlockThatComesBackWasMoved) {
  ObservedCell run({{1, "", goal::Untouched{{"red"}, 1'000}}});
  pick_red(run);
  for (const char* move : {"E-20\r", "E+20\r", "A-60\r"}) {
    run.send(move);
    run.run_to_rest();
  }
  EXPECT_TRUE(run.observer->facts().breaches[0]);
}

TEST(RunObserver, ATipThatOnlyPassesThroughABoxWasInIt) {
  const PointUm tip = tool_tip(*observed_model(), {});
  ObservedCell run({{1, "", goal::KeepOut{{{tip.x - 60'000, 20'000, 0}, {tip.x, 25'000, tip.z}}}}});
  run.send("F+60\r");
  run.run_to_rest();
  const std::optional<Breach> breach = run.observer->facts().breaches[0];
  ASSERT_TRUE(breach);
  EXPECT_GT(breach->tick, 0);
  EXPECT_GE(breach->at.y, 20'000);
  EXPECT_LT(breach->at.y, 22'000);
}

TEST(RunObserver, TheFirstStall) {
  ObservedCell run;
  for (int i = 0; i < 20 && !run.observer->facts().stall; ++i) {
    run.send("E-120\r");
    run.run_to_rest();
  }
  EXPECT_TRUE(run.observer->facts().stall);
  EXPECT_GT(run.observer->facts().stall_tick, 0);
}

TEST(RunObserver, ProblemsAreCountedByCodeEvenIfTheirMessagesAreSuppressed) {
  ObservedCell run;
  std::string bytes;
  for (int i = 0; i < 200; ++i) bytes += "y?";
  run.send(bytes);
  run.send("E+1\r");
  run.cell.apply(InputEnded{1}, 0);
  run.cell.apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  const RunFacts facts = run.observer->facts();
  EXPECT_GE(facts.problem_count, 200U);
  EXPECT_LE(facts.problems.size(), 3U);
}

TEST(RunObserver, AWatcherDoesNotChangeTheRun) {
  ObservedCell watched;
  ObservedCell alone;
  alone.observer.reset();
  for (ObservedCell* run : {&watched, &alone}) {
    pick_red(*run);
    run->send("E-60\rF+100\rE?F?");
    run->cell.apply(InputEnded{1}, 0);
  }
  EXPECT_EQ(watched.cell.state(), alone.cell.state());
}

}  // namespace
}  // namespace xr3
