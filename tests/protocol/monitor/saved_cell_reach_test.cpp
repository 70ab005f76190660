// Machines with random commands and changing workcells: every state that they reach can be saved
// and loaded. Refusing a reachable state would be worse than accepting an invented one.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/carousel.hpp"
#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

constexpr int kActions = 250;
constexpr Counts kFar = 100;

struct Ground {
  const char* robot;  ///< empty: test::odd_arm() with this many joints
  int joints;
  std::initializer_list<test::LabelledCount> centre;  ///< the counts around which the tool moves
};

const std::array<Ground, 7> kGrounds = {{
    {"rhino-xr3", 5, {{'E', 449}, {'D', -625}}},
    {"rhino-xr3", 5, {{'E', -200}}},
    {"adept-one", 4, {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}}},
    {"intelledex-660", 6, {{'E', 293}, {'D', -932}, {'C', -261}}},
    {"rhino-xr3-accessories", 6, {{'G', 500}, {'F', 75}, {'E', 425}, {'D', -584}}},
    {"", 7, {}},
    {"", 2, {}},
}};

/// Statistics of what happened to the machines.
struct Tally {
  int region_stalls = 0;
  int surface_stalls = 0;
  int held_tilted = 0;
  int limited = 0;
  int jammed = 0;
  int below = 0;
  int stalled_and_stopped = 0;  ///< all counters were set to 0 after the stall
  int paths = 0;
  int turned = 0;  ///< a block on the carousel is not where it was put
};

class Wanderer {
 public:
  Wanderer(std::uint32_t seed, Tally& tally)
      : engine_(seed),
        ground_(
            kGrounds.at(static_cast<std::size_t>(any(0, static_cast<int>(kGrounds.size()) - 1)))),
        profile_(one_in(3) ? Profile::kMark3 : Profile::kPaper),
        robot_(any_robot()),
        rig_(any_model()),
        tally_(tally) {}

  /// The first state that would be refused; empty if there is none.
  std::string wander() {
    for (int i = 0; i < kActions; ++i) {
      act();
      note();
      std::string wrong = one_in(4) ? validate_now() : "";
      if (wrong.empty() && one_in(100)) wrong = load_again();
      if (!wrong.empty()) return wrong;
    }
    return load_again();
  }

 private:
  int any(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint32_t>(high - low + 1));
  }
  bool one_in(int chances) { return any(1, chances) == 1; }
  char any_label() { return static_cast<char>('A' + any(0, model().joint_count() + 1)); }

  const Model& model() const { return rig_.model(); }
  const State& state() const { return rig_.state(); }
  State& edit() { return rig_.simulation.edit(); }
  PointUm tip() const { return tool_tip(model(), positions(model(), state().motors)); }

  /// The tip at the centre of the motions.
  PointUm centre(const Robot& robot) const {
    const ModelPtr model = test::model_of(robot);
    return tool_tip(*model, test::positions_at(*model, ground_.centre));
  }

  /// Some robots have a protected region near the centre, if the soft home is outside it.
  Robot any_robot() {
    Robot robot =
        *ground_.robot != 0 ? test::robot_named(ground_.robot) : test::odd_arm(ground_.joints);
    if (one_in(3)) return robot;
    const PointUm about = centre(robot);
    const ProtectedRegion file = robot.protected_region;
    robot.protected_region = {std::max(0.0, std::hypot(mm(about.x), mm(about.y)) - any(-10, 30)),
                              std::max(0.0, mm(about.z) + any(-30, 60))};
    const ModelPtr model = test::model_of(robot);
    if (is_in_protected_region(*model, {}, tool_tip(*model, {}))) robot.protected_region = file;
    return robot;
  }

  Block any_block(const PointUm& about) {
    const PointUm size{any(10'000, 60'000), any(6'000, 35'000), any(30'000, 90'000)};
    PointUm centroid{about.x + any(-25'000, 25'000), about.y + any(-25'000, 25'000),
                     about.z + any(-25'000, 25'000)};
    if (robot_.carousel && one_in(2)) {
      centroid.z = micrometres(robot_.carousel->height_mm) + size.z / 2 + any(-2'200, 2'200);
    }
    return {"block " + std::to_string(++blocks_), size, centroid,
            microdegrees(any(-179'999, 180'000) / 1000.0), any(0, 15)};
  }

  Workcell any_workcell(const PointUm& about) {
    Workcell workcell = test::bare_workcell();
    workcell.workspace.z_um = 10'000'000;
    workcell.work_surface_um = about.z + any(-40'000, 10'000);
    workcell.surface_stalls = one_in(2);
    for (int i = any(0, 8); i > 0; --i) workcell.blocks.edit().push_back(any_block(about));
    return workcell;
  }

  ModelPtr any_model() {
    return std::make_shared<const Model>(robot_, any_workcell(centre(robot_)), profile_);
  }

  void act() {
    const bool is_stalled = state().stall != Stall::kNo;
    const int what = any(0, 99);
    if (what < 40) return rig_.pass(one_in(4) ? 1500 : any(0, 250));
    if (what < 60) return arm();
    if (what < 78) return jaws();
    if (what < 82) return rig_.move(any_label(), any(-128, 127));
    if (what < 85) return void(rig_.execute(Stop{any_label()}));
    if (what < 88) return void(rig_.execute(SetSpeed{any_label(), any(20, 255)}));
    if (what < 90) return setting();
    if (what < 96) return block();
    if (what < 97) return workcell();
    if (one_in(is_stalled ? 2 : 20)) rig_.execute(SoftHome{});
  }

  void setting() {
    if (one_in(2)) return void(rig_.execute(ToggleErasing{}));
    if (one_in(2)) return void(rig_.execute(ControllerReset{}));
    rig_.execute(ToggleSimulator{});
  }

  /// If the arm is far away, as after a home, every joint moves straight back; else some move
  /// around the centre.
  void arm() {
    bool is_far = false;
    for (const auto& [label, count] : ground_.centre) {
      const Counts left = count - rig_.count(label) - rig_.error(label);
      if (std::abs(left) <= kFar) continue;
      rig_.move(label, std::clamp(left, -kFar, kFar));
      is_far = true;
    }
    if (model().carousel() && one_in(2)) rig_.move('H', any(-60, 60));
    for (int i = any(1, 4); i > 0 && !is_far; --i)
      rig_.move(model().motor(any(0, model().joint_count() - 1)).drive.label, any(-25, 25));
  }

  /// Jaws that hold a block mostly continue to close; others open wide and close again.
  void jaws() {
    const bool opens = one_in(state().held ? 6 : 2);
    if (opens) rig_.execute(Stop{'A'});
    rig_.move('A', opens ? -30 * any(1, 4) : any(1, 100));
  }

  /// As the monitor's calls do: a held block is not changed.
  void block() {
    const std::size_t size = state().blocks.size();
    if (one_in(3) || size == 0) {
      edit().blocks.edit().push_back(any_block(tip()));
      return find_riders(model(), edit());
    }
    const auto index = static_cast<std::size_t>(any(0, static_cast<int>(size) - 1));
    if (is_held(state(), index)) return;
    if (one_in(4)) return remove_block(model(), edit(), index);
    const Block place = any_block(tip());
    edit().blocks.edit()[index].centroid_um = one_in(4) ? tip() : place.centroid_um;
    edit().blocks.edit()[index].yaw_udeg = place.yaw_udeg;
    find_riders(model(), edit());
  }

  void workcell() {
    rig_.simulation.replace_workcell(
        std::make_shared<const Model>(robot_, any_workcell(tip()), profile_));
  }

  SavedCell saved() const { return {"sha256:1", model().workcell(), state()}; }

  std::string validate_now() const {
    std::string wrong;
    for (const monitor::Detail& detail : monitor::validate(model(), saved())) {
      wrong += detail.pointer + ": " + detail.found.dump() + "; allowed: " + detail.allowed + "\n";
    }
    return wrong.empty() ? wrong : wrong + test::words(state());
  }

  /// Continues from the saved and reloaded state.
  std::string load_again() {
    FileReading<SavedCell> reading =
        read_saved_cell(Json::parse(saved_cell_to_json(saved()).dump()));
    if (!reading.value) return to_text(reading.findings);
    if (!(*reading.value == saved())) return "not the same when it is read again";
    rig_.simulation.restore(
        std::make_shared<const Model>(robot_, reading.value->workcell, profile_),
        std::move(reading.value->state));
    return "";
  }

  void note() {
    tally_.region_stalls += state().stall == Stall::kProtectedRegion ? 1 : 0;
    tally_.surface_stalls += state().stall == Stall::kWorkSurface ? 1 : 0;
    tally_.below += state().below_surface ? 1 : 0;
    for (const Rider& rider : state().riders)
      tally_.turned += state().motor(model().carousel_index()).count != rider.count ? 1 : 0;
    tally_.paths += state().tip_path.points.empty() ? 0 : 1;
    const bool carried =
        state().held && state().held->grasped_at != positions(model(), state().motors);
    tally_.held_tilted += carried ? 1 : 0;
    for (const MotorState& motor : state().motors) {
      tally_.limited += motor.blocked == Blocked::kLimit ? 1 : 0;
      tally_.jammed += motor.blocked == Blocked::kBlock ? 1 : 0;
    }
    const bool has_moves = std::any_of(state().motors.begin(), state().motors.end(),
                                       [](const MotorState& motor) { return motor.error != 0; });
    tally_.stalled_and_stopped += state().stall != Stall::kNo && !has_moves ? 1 : 0;
  }

  std::mt19937 engine_;
  int blocks_ = 0;
  const Ground& ground_;
  Profile profile_;
  Robot robot_;
  test::Rig rig_;
  Tally& tally_;
};

// For many more runs: RC_PARAMS=max_success=100000.
RC_GTEST_PROP(SavedCellReach, EveryReachedStateCanBeLoaded, ()) {
  Tally tally;
  const auto seed = *rc::gen::noShrink(rc::gen::resize(100, rc::gen::arbitrary<std::uint32_t>()));
  const std::string wrong = Wanderer(seed, tally).wander();
  RC_ASSERT(wrong == "");
}

TEST(SavedCellReach, TheMachinesReachEveryKindOfState) {
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 60; ++seed)
    ASSERT_EQ(Wanderer(seed, tally).wander(), "") << "seed " << seed;
  EXPECT_GT(tally.region_stalls, 200);
  EXPECT_GT(tally.surface_stalls, 200);
  EXPECT_GT(tally.held_tilted, 200);
  EXPECT_GT(tally.limited, 200);
  EXPECT_GT(tally.jammed, 200);
  EXPECT_GT(tally.below, 200);
  EXPECT_GT(tally.stalled_and_stopped, 5);
  EXPECT_GT(tally.paths, 200);
  EXPECT_GT(tally.turned, 200);
}

}  // namespace
}  // namespace xr3
