// A hundred thousand random motions of arm and jaws among blocks, checked count by count: no block
// is lost, duplicated, squeezed or moved without contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

constexpr int kBlocks = 12;
constexpr int kMotionsPerRun = 1000;
constexpr Counts kWindow = 35;
constexpr Counts kFar = 100;
constexpr double kHairUm = 2;
constexpr double kRoundingDeg = 2e-6;
constexpr Tick kMaxRestLength = 128'000;

struct Ground {
  const char* robot;
  std::initializer_list<test::LabelledCount> centre;  ///< the counts around which the tool moves
  int runs;
};

const Ground kGrounds[] = {
    {"rhino-xr3", {{'E', 449}, {'D', -625}}, 60},
    {"adept-one", {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}}, 15},
    {"intelledex-660", {{'E', 293}, {'D', -932}, {'C', -261}}, 25},
};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  /// low...high, the same on every machine.
  int any(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint32_t>(high - low + 1));
  }
  bool one_in(int chances) { return any(1, chances) == 1; }

 private:
  std::mt19937 engine_;
};

/// Blocks of all shapes around a point, which may overlap.
std::vector<Block> scattered(Dice& dice, const PointUm& about) {
  std::vector<Block> blocks;
  for (int i = 0; i < kBlocks; ++i) {
    const PointUm size{dice.any(10'000, 60'000), dice.any(6'000, 35'000), dice.any(30'000, 90'000)};
    const PointUm centroid{about.x + dice.any(-45'000, 45'000), about.y + dice.any(-45'000, 45'000),
                           about.z + dice.any(-40'000, 40'000)};
    blocks.push_back({"block " + std::to_string(i), size, centroid,
                      microdegrees(dice.any(-179'999, 180'000) / 1000.0), i % 16});
  }
  return blocks;
}

/// In some cells the protected region extends to where the tool moves, or the surface stalls.
ModelPtr random_cell(const Ground& ground, Dice& dice) {
  const ModelPtr bare = test::model_of(test::robot_named(ground.robot));
  const PointUm about = tool_tip(*bare, test::positions_at(*bare, ground.centre));
  Robot robot = test::robot_named(ground.robot);
  if (dice.one_in(3)) {
    robot.protected_region = {std::hypot(mm(about.x), mm(about.y)) - 20, mm(about.z) + 60};
  }
  Workcell workcell = test::bare_workcell();
  workcell.blocks = scattered(dice, about);
  workcell.work_surface_um = about.z - 20'000;
  workcell.surface_stalls = dice.one_in(3);
  return std::make_shared<const Model>(robot, workcell, Profile::kPaper);
}

double squared(double x) { return x * x; }

double distance(const PointUm& a, const PointUm& b) {
  return std::sqrt(squared(static_cast<double>(a.x - b.x)) +
                   squared(static_cast<double>(a.y - b.y)) +
                   squared(static_cast<double>(a.z - b.z)));
}

/// The point is in the upright block, or outside by a small tolerance.
bool is_in(const Block& block, const PointUm& point) {
  const double yaw = degrees(block.yaw_udeg) * kPi / 180;
  const auto dx = static_cast<double>(point.x - block.centroid_um.x);
  const auto dy = static_cast<double>(point.y - block.centroid_um.y);
  const double along = std::cos(yaw) * dx + std::sin(yaw) * dy;
  const double across = std::cos(yaw) * dy - std::sin(yaw) * dx;
  const double up = static_cast<double>(point.z - block.centroid_um.z);
  return std::abs(along) <= static_cast<double>(block.size_um.x) / 2 + kHairUm &&
         std::abs(across) <= static_cast<double>(block.size_um.y) / 2 + kHairUm &&
         std::abs(up) <= static_cast<double>(block.size_um.z) / 2 + kHairUm;
}

/// Distance of the difference of two yaws from a multiple of 90 degrees.
double off_quarter(double yaw, double other) { return std::abs(std::remainder(yaw - other, 90.0)); }

struct ChannelStats {
  int grasps = 0;
  int releases = 0;
  int turns = 0;
  int stalls = 0;
  int homes = 0;
  int too_narrow = 0;
};

/// A machine that gets random commands, and a twin that gets the same commands at the same ticks
/// but advances in different steps.
class Wanderer {
 public:
  Wanderer(const Ground& ground, std::uint32_t seed, ChannelStats& stats)
      : dice_(seed),
        ground_(ground),
        rig_(random_cell(ground, dice_)),
        twin_(rig_.simulation),
        tally_(stats) {
    if (!dice_.one_in(4)) rig_.stand_at(ground.centre);
    twin_ = rig_.simulation;
  }

  void wander() {
    for (int i = 0; i < kMotionsPerRun && !testing::Test::HasFailure(); ++i) {
      motion();
      watch_until(rig_.simulation.tick() + (dice_.one_in(3) ? 1500 : dice_.any(0, 250)));
      twin_.advance_to(rig_.simulation.tick());
      EXPECT_EQ(rig_.state(), twin_.state());
      check_always();
    }
    comes_to_rest();
    count_events();
  }

 private:
  const Model& model() const { return rig_.model(); }
  const State& state() const { return rig_.state(); }
  Positions where(const State& state) const { return positions(model(), state.motors); }
  Micrometres opening(const State& state) const {
    return micrometres(
        opening_mm(model(), where(state)[static_cast<std::size_t>(model().tool_index())]));
  }
  static Micrometres flat(const Block& block, int quarter_turns) {
    return quarter_turns % 2 == 0 ? block.size_um.y : block.size_um.x;
  }

  void both(const Command& command) {
    rig_.execute(command);
    twin_.execute(command);
  }

  // Moves some of the arm's motors or the jaws around the centre; sometimes does something else.
  void motion() {
    const bool is_stalled = state().stall != Stall::kNo;
    if (dice_.one_in(is_stalled ? 3 : 400)) return home();
    if (dice_.one_in(30)) return both(Stop{any_label()});
    if (dice_.one_in(30)) return both(SetSpeed{any_label(), dice_.any(20, 255)});
    if (dice_.one_in(100)) return both(ControllerReset{});
    if (dice_.one_in(2)) return jaws();
    arm();
  }

  char any_label() { return static_cast<char>('A' + dice_.any(0, model().joint_count())); }

  void home() {
    ++tally_.homes;
    const State before = state();
    both(SoftHome{});
    if (before.held) check_released(before, state(), where(before));
    check_changes(before, before.held ? static_cast<int>(before.held->block) : -1);
  }

  // Jaws that hold a block mostly continue to close; others open wide and close again.
  void jaws() {
    const bool opens = dice_.one_in(state().held ? 5 : 2);
    if (opens) both(Stop{'A'});
    both(Move{'A', opens ? -30 * dice_.any(1, 4) : dice_.any(1, 100)});
  }

  // If the arm is far away, as after a home, every joint moves straight back.
  void arm() {
    bool is_far = false;
    for (const auto& [label, count] : ground_.centre) {
      const Counts left = count - rig_.count(label) - rig_.error(label);
      if (std::abs(left) <= kFar) continue;
      both(Move{label, std::clamp(left, -kFar, kFar)});
      is_far = true;
    }
    for (int i = dice_.any(1, 3); i > 0 && !is_far; --i)
      wander(static_cast<char>('B' + dice_.any(0, model().joint_count() - 1)));
  }

  void wander(char label) {
    Counts wanted = dice_.any(-kWindow, kWindow);
    for (const auto& [centre_label, count] : ground_.centre) {
      if (centre_label == label) wanted += count;
    }
    both(Move{label, std::clamp(wanted - rig_.count(label) - rig_.error(label), -25, 25)});
  }

  // Between two counts of the jaws no block changes; check_count() has the changes allowed at a
  // count.
  void watch_until(Tick until) {
    const int tool = model().tool_index();
    while (rig_.simulation.tick() < until) {
      const Tick left = until - rig_.simulation.tick();
      const bool runs = state().stall == Stall::kNo && is_running(state().motor(tool));
      const Tick quiet = runs ? std::min(left, ticks_to_count(state().motor(tool)) - 1) : left;
      if (quiet > 0) {
        const State before = state();
        rig_.pass(quiet);
        EXPECT_EQ(before.blocks, state().blocks);
        EXPECT_EQ(before.held, state().held);
        continue;
      }
      const State before = state();
      rig_.pass(1);
      check_count(before);
    }
  }

  void check_count(const State& before) {
    const State& after = state();
    const int tool = model().tool_index();
    const Counts turned = after.motor(tool).count - before.motor(tool).count;
    if (after.stall != Stall::kNo) {
      check_changes(before, -1);
      EXPECT_EQ(before.held, after.held);
    } else if (before.held) {
      EXPECT_EQ(after.held.has_value(), turned == 0)
          << "the first opening count releases the block";
      if (!after.held) check_released(before, after, where(after));
      check_changes(before, static_cast<int>(before.held->block));
    } else if (after.held) {
      EXPECT_EQ(turned, 0) << "the count that would squeeze the block is not made";
      check_grasped(before);
    } else {
      check_turned(before, turned);
    }
  }

  void check_released(const State& before, const State& after, const Positions& at) const {
    EXPECT_FALSE(after.held);
    const Block& block = after.blocks[before.held->block];
    EXPECT_EQ(block.centroid_um, tool_tip(model(), at));
    const double yaw = net_roll_deg(model(), at) + 90 * before.held->quarter_turns;
    EXPECT_LT(std::abs(std::remainder(degrees(block.yaw_udeg) - yaw, 360.0)), kRoundingDeg);
  }

  void check_grasped(const State& before) const {
    const auto& [index, quarter_turns, grasped_at] = *state().held;
    const PointUm tip = tool_tip(model(), where(state()));
    const Block& was = before.blocks[index];
    const Block& is = state().blocks[index];
    EXPECT_TRUE(is_in(was, tip));
    for (const Block& other : before.blocks) {
      if (is_in(other, tip))
        EXPECT_LE(distance(was.centroid_um, tip), distance(other.centroid_um, tip) + kHairUm);
    }
    EXPECT_EQ(is.centroid_um, tip);
    EXPECT_EQ(grasped_at, where(state()));
    check_flat(was, is);
    EXPECT_GE(static_cast<double>(opening(before)) + kHairUm, extent(was)) << "too narrow";
    EXPECT_LT(opening(state()) - micrometres(8.0), flat(is, quarter_turns))
        << "no sooner than needed";
    check_changes(before, static_cast<int>(index));
  }

  /// Extent along the jaws' current direction, in micrometres.
  double extent(const Block& block) const {
    const double delta = degrees(block.yaw_udeg) - net_roll_deg(model(), where(state()));
    return static_cast<double>(block.size_um.y) * std::abs(std::cos(delta * kPi / 180)) +
           static_cast<double>(block.size_um.x) * std::abs(std::sin(delta * kPi / 180));
  }

  void check_flat(const Block& was, const Block& is) const {
    EXPECT_LT(off_quarter(degrees(is.yaw_udeg), net_roll_deg(model(), where(state()))),
              kRoundingDeg);
    const double by = std::remainder(degrees(is.yaw_udeg - was.yaw_udeg), 360.0);
    EXPECT_LE(std::abs(by), 45 + kRoundingDeg) << "to the nearest";
  }

  void check_turned(const State& before, Counts turned) {
    for (std::size_t i = 0; i < before.blocks.size(); ++i) {
      const Block& was = before.blocks[i];
      const Block& is = state().blocks[i];
      if (is == was) continue;
      ++tally_.turns;
      EXPECT_GT(turned, 0) << "only closing jaws turn a block";
      EXPECT_TRUE(is_in(was, tool_tip(model(), where(state()))));
      EXPECT_EQ(is.centroid_um, was.centroid_um);
      check_flat(was, is);
      EXPECT_GE(static_cast<double>(opening(before)) + kHairUm, extent(was)) << "too narrow";
      EXPECT_LT(static_cast<double>(opening(state())), extent(was) + kHairUm) << "no need to";
      check_changes(before, static_cast<int>(i));
    }
  }

  /// No block except `allowed` (-1: none) has changed.
  void check_changes(const State& before, int allowed) const {
    for (std::size_t i = 0; i < before.blocks.size(); ++i) {
      if (static_cast<int>(i) != allowed) EXPECT_EQ(before.blocks[i], state().blocks[i]);
    }
  }

  void check_always() const {
    const std::vector<Block>& first = model().workcell().blocks;
    ASSERT_EQ(state().blocks.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(state().blocks[i].name, first[i].name);
      EXPECT_EQ(state().blocks[i].size_um, first[i].size_um);
      EXPECT_EQ(state().blocks[i].color, first[i].color);
    }
    if (!state().held) return;
    const auto& [index, quarter_turns, grasped_at] = *state().held;
    EXPECT_GE(opening(state()), flat(state().blocks[index], quarter_turns) - 1);
    const Transform pose = block_pose(model(), state(), index);
    const PointUm centroid{micrometres(pose(0, 3)), micrometres(pose(1, 3)),
                           micrometres(pose(2, 3))};
    EXPECT_LE(distance(centroid, tool_tip(model(), where(state()))), kHairUm);
  }

  void comes_to_rest() {
    watch_until(rig_.simulation.tick() + kMaxRestLength);
    EXPECT_TRUE(rig_.simulation.is_at_rest());
    State rest = state();
    rig_.pass(1'000'000);
    rest.tick += 1'000'000;
    EXPECT_EQ(state(), rest);
    check_always();
  }

  void count_events() {
    const int grasps = static_cast<int>(rig_.events_of<Grasped>().size());
    const int releases = static_cast<int>(rig_.events_of<Released>().size());
    EXPECT_EQ(grasps, releases + (state().held ? 1 : 0));
    twin_.advance_to(rig_.simulation.tick());
    EXPECT_EQ(rig_.simulation.events(), twin_.events());
    tally_.grasps += grasps;
    tally_.releases += releases;
    tally_.stalls += static_cast<int>(rig_.events_of<Stalled>().size());
    for (const Warning& warning : rig_.events_of<Warning>())
      tally_.too_narrow += warning.code == WarningCode::kJawsTooNarrow ? 1 : 0;
  }

  Dice dice_;
  const Ground& ground_;
  test::Rig rig_;
  Simulation twin_;
  ChannelStats& tally_;
};

TEST(GraspProperty, BlocksAreKeptThroughAHundredThousandMotions) {
  ChannelStats stats;
  std::uint32_t seed = 1989;
  for (const Ground& ground : kGrounds) {
    for (int run = 0; run < ground.runs; ++run, ++seed) {
      SCOPED_TRACE(std::string(ground.robot) + ", seed " + std::to_string(seed));
      Wanderer(ground, seed, stats).wander();
      ASSERT_FALSE(HasFailure());
    }
  }
  // The motions were effective.
  EXPECT_GT(stats.grasps, 1000);
  EXPECT_GT(stats.releases, 1000);
  EXPECT_GT(stats.turns, 1000);
  EXPECT_GT(stats.stalls, 100);
  EXPECT_GT(stats.homes, 200);
  EXPECT_GT(stats.too_narrow, 500);
}

}  // namespace
}  // namespace xr3
