// Bit-identical round trips of saved cells; invented ones are refused with all reasons.
#include "protocol/monitor/saved_cell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/home.hpp"
#include "core/simulation.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using Strings = std::vector<std::string>;

SavedCell at_home() {
  const ModelPtr model = test::rhino();
  SavedCell saved{"sha256:1", test::workcell_named("rhino-xr3"), initial_state(*model)};
  saved.state.blocks = saved.workcell.blocks;
  return saved;
}

Json at_home_json() { return saved_cell_to_json(at_home()); }

FileReading<SavedCell> read_again(const SavedCell& saved) {
  return read_saved_cell(Json::parse(saved_cell_to_json(saved).dump()));
}

Strings wrong_in(const Json& json) {
  const FileReading<SavedCell> reading = read_saved_cell(json);
  EXPECT_EQ(reading.value.has_value(), !has_errors(reading.findings));
  Strings pointers;
  for (const Finding& finding : reading.findings) {
    if (finding.severity == Severity::kError) pointers.push_back(finding.pointer);
  }
  return pointers;
}

// --- Generators.

template <class I>
I any(std::int64_t low, std::int64_t high) {
  return static_cast<I>(*rc::gen::resize(1000, rc::gen::inRange(low, high + 1)));
}

bool any_bool() { return *rc::gen::arbitrary<bool>(); }

template <class I>
I any_of_all() {
  return any<I>(std::numeric_limits<I>::min(), std::numeric_limits<I>::max());
}

PointUm any_point(Micrometres low, Micrometres high) {
  return {any<Micrometres>(low, high), any<Micrometres>(low, high), any<Micrometres>(low, high)};
}

PointUm any_place() { return any_point(-2'000'000'000, 2'000'000'000); }

Counts any_count() { return any<Counts>(-(1 << 30), 1 << 30); }

MotorState any_motor() {
  MotorState motor;
  motor.count = any_count();
  motor.phase = any<std::int16_t>(0, 999);
  motor.error = any_of_all<std::int8_t>();
  motor.speed = any<std::uint8_t>(1, 255);
  motor.blocked = *rc::gen::element(Blocked::kNo, Blocked::kLimit, Blocked::kBlock);
  motor.switch_closed = any_bool();
  return motor;
}

std::vector<Block> any_blocks(Micrometres farthest) {
  std::vector<Block> blocks(any<std::size_t>(0, 4));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i] = {"block \" \xC3\xA9 " + std::to_string(i), any_point(1, 100'000'000),
                 any_point(-farthest, farthest), any<Microdegrees>(-179'999'999, 180'000'000),
                 any<int>(0, 15)};
  }
  return blocks;
}

Held any_held(std::size_t blocks) {
  Held held{any<std::uint32_t>(0, static_cast<std::int64_t>(blocks) - 1), any<int>(0, 3), {}};
  for (Counts& position : held.grasped_at) position = any_count();
  return held;
}

TipPath any_path() {
  TipPath path;
  const bool is_full = any_bool();
  std::vector<PointUm>& points = path.points.edit();
  points.resize(is_full ? TipPath::kMaxTipPoints : any<std::size_t>(0, 5));
  for (PointUm& point : points) point.x = &point - points.data() - 2000;
  if (!points.empty()) points.front() = any_place();
  if (is_full) path.oldest = any<std::size_t>(0, TipPath::kMaxTipPoints - 1);
  return path;
}

/// Riders for some of the blocks that are not held.
std::vector<Rider> any_riders(const State& state) {
  std::vector<Rider> riders;
  for (std::uint32_t block = 0; block < state.blocks.size(); ++block) {
    if ((state.held && state.held->block == block) || any_bool()) continue;
    riders.push_back({block, any<Counts>(-1'000'000, 1'000'000), any_place(),
                      any<Microdegrees>(-179'999'999, 180'000'000)});
  }
  return riders;
}

State any_state() {
  State state;
  state.tick = any<Tick>(0, monitor::kMaxInteger);
  for (MotorState& motor : state.motors) motor = any_motor();
  state.stall = *rc::gen::element(Stall::kNo, Stall::kProtectedRegion, Stall::kWorkSurface);
  state.below_surface = any_bool();
  state.enabled = any_bool();
  state.display = {any_bool(),       {any<int>(-9, 9), any<int>(-9, 9), 3},
                   any<int>(1, 255), any_bool(),
                   any<int>(0, 6),   any_bool()};
  state.io = {any_of_all<std::uint8_t>(), any_of_all<std::uint8_t>(), any<std::uint8_t>(0, 3)};
  state.blocks = any_blocks(2'000'000'000);
  if (!state.blocks.empty() && any_bool()) state.held = any_held(state.blocks.size());
  state.riders = any_riders(state);
  state.jaws_warned = any_bool();
  state.tip_path = any_path();
  return state;
}

Workcell any_workcell() {
  Workcell workcell = test::workcell_named("rhino-xr3");
  workcell.notes = any_bool() ? "two\nlines" : "";
  workcell.workspace = {any<Micrometres>(1, 100'000'000), any<Micrometres>(1, 100'000'000),
                        100'000'000};
  workcell.work_surface_um = any<Micrometres>(-100'000'000, 99'999'999);
  workcell.surface_stalls = any_bool();
  workcell.blocks = any_blocks(100'000'000);
  workcell.camera->location_um = {any<Micrometres>(-100'000'000, 100'000'000), 0, 100'000'000};
  if (any_bool()) workcell.camera.reset();
  return workcell;
}

TEST(SavedCellJson, WithoutACarouselHasNoRiders) {
  const SavedCell saved{"sha256:1", test::bare_workcell(), initial_state(*test::rhino())};
  EXPECT_FALSE(saved_cell_to_json(saved)["state"].contains("riders"));
}

TEST(SavedCellJson, RejectsRidersThatAreNoBlocksInOrder) {
  SavedCell saved{"sha256:1", test::bare_workcell(), initial_state(*test::rhino())};
  saved.state.blocks = test::workcell_named("rhino-xr3").blocks;
  saved.state.riders = {{1, 0, {}, 0}, {1, 0, {}, 0}, {4, 0, {}, 0}, {5, 0, {}, 0}};
  Strings pointers;
  for (const Finding& finding : read_again(saved).findings) pointers.push_back(finding.pointer);
  EXPECT_EQ(pointers, (Strings{"/state/riders/1/block", "/state/riders/3/block"}));
}

RC_GTEST_PROP(SavedCellJson, EveryBitRoundTrips, ()) {
  const SavedCell saved{"sha256:" + std::to_string(any<int>(0, 1000)), any_workcell(), any_state()};
  const FileReading<SavedCell> reading = read_again(saved);
  RC_ASSERT(to_text(reading.findings).find("error") == std::string::npos);
  RC_ASSERT(reading.value.has_value());
  RC_ASSERT(*reading.value == saved);
}

// --- Reachable states.

TEST(SavedCellJson, AMachineContinuesFromIt) {
  const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  Simulation one(model);
  one.execute(ToggleErasing{});
  for (const char label : {'F', 'E', 'D', 'C', 'B', 'A'}) one.execute(Move{label, -40});
  one.advance_to(123);
  const SavedCell saved{"sha256:1", model->workcell(), one.state()};
  const FileReading<SavedCell> reading = read_again(saved);
  ASSERT_TRUE(reading.value);
  EXPECT_TRUE(monitor::validate(*model, *reading.value).empty());
  Simulation other(model);
  other.restore(reading.value->state);
  one.advance_to(2000);
  other.advance_to(2000);
  EXPECT_EQ(one.state(), other.state());
}

Fault slip_of(char joint) {
  Fault fault;
  fault.name = "slip";
  fault.kind = FaultKind::kEncoderSlip;
  fault.joint = joint;
  fault.chance = 123'456'789;
  fault.from_tick = 0;
  return fault;
}

Fault stuck_switch() {
  Fault fault;
  fault.name = "stuck";
  fault.kind = FaultKind::kSwitchStuckClosed;
  fault.joint = 'D';
  fault.at_tick = 100;
  fault.ticks = 500;
  return fault;
}

TEST(SavedCellJson, AMachineWithFaultsContinuesFromIt) {
  const ModelPtr model = test::rhino();
  Simulation one(model);
  one.install_faults({5, {slip_of('E'), stuck_switch()}});
  one.execute(Move{'E', 100});
  one.advance_to(300);
  ASSERT_GT(one.state().faults.all[0].effects, 0U);
  const SavedCell saved{"sha256:1", model->workcell(), one.state()};
  const FileReading<SavedCell> reading = read_again(saved);
  ASSERT_TRUE(reading.value) << to_text(reading.findings);
  EXPECT_TRUE(monitor::validate(*model, *reading.value).empty());
  Simulation other(model);
  other.restore(reading.value->state);
  EXPECT_EQ(one.state(), other.state());
  one.take_events();
  one.advance_to(2000);
  other.advance_to(2000);
  EXPECT_EQ(one.state(), other.state());
  EXPECT_EQ(one.events(), other.events());
}

TEST(SavedCellJson, RejectsFaultsThatAFileMayNotHave) {
  Simulation one(test::rhino());
  one.install_faults({5, {slip_of('E'), stuck_switch()}});
  SavedCell saved{"sha256:1", test::bare_workcell(), one.state()};
  saved.state.faults.all[1].fault.name = "slip";
  saved.state.faults.all[1].fault.count = 3;
  Strings pointers;
  for (const Finding& finding : read_again(saved).findings) pointers.push_back(finding.pointer);
  EXPECT_EQ(pointers,
            (Strings{"/state/faults/all/1/fault/count", "/state/faults/all/1/fault/count"}));
}

TEST(SavedCellJson, FaultsOfJointsThatTheRobotLacksAreInvalid) {
  SavedCell saved{"sha256:1", test::bare_workcell(), initial_state(*test::rhino())};
  saved.state.faults.all.push_back({slip_of('G')});
  const auto details = monitor::validate(*test::rhino(), saved);
  ASSERT_EQ(details.size(), 1U);
  EXPECT_EQ(details[0].pointer, "/state/faults/all/0/fault/joint");
}

TEST(SavedCellJson, AFullPathFitsAMessage) {
  SavedCell saved = at_home();
  saved.workcell.blocks = test::workcell_named("rhino-hundred").blocks;
  saved.state.blocks = saved.workcell.blocks;
  for (int i = 0; i < 4096; ++i) saved.state.tip_path.add({-238'101 + i, -400'000, -320'700});
  EXPECT_LT(saved_cell_to_json(saved).dump().size(), monitor::kMaxMessageBytes * 3 / 4);
}

TEST(SavedCellJson, ACellThatFitsARequestCanBeSentBack) {
  SavedCell saved = at_home();
  saved.state.blocks = {};
  const std::string before = R"({"op":"call","id":")" + std::string(64, '7') +
                             R"(","cell":"main","fn":"snapshot_load","args":{"snapshot":)";
  constexpr std::size_t kMore = 100;
  Block block = saved.workcell.blocks[0];
  block.name = "10000000";
  saved.state.blocks.edit().resize(1000, block);
  while (monitor::fits_a_request(saved))
    saved.state.blocks.edit().resize(saved.state.blocks.size() + kMore, block);
  saved.state.blocks.edit().resize(saved.state.blocks.size() - kMore);
  for (std::size_t i = 0; i < saved.state.blocks.size(); ++i)
    saved.state.blocks.edit()[i].name = std::to_string(10'000'000 + i);
  ASSERT_TRUE(monitor::fits_a_request(saved));
  const auto reading = monitor::read_request(before + saved_cell_to_json(saved).dump() + "}}");
  EXPECT_TRUE(std::holds_alternative<monitor::Request>(reading));
}

// Without names, rotation and colour a block is as short as it can be.
TEST(SavedCellJson, BlocksThatFitAreNotRefusedByTheirNumber) {
  SavedCell saved = at_home();
  const std::size_t empty = saved_cell_to_json(saved).dump().size();
  Block block;
  block.size_um = {1000, 1000, 1000};
  saved.workcell.blocks.edit().push_back(block);
  const std::size_t in_workcell = saved_cell_to_json(saved).dump().size() - empty;
  EXPECT_GT(in_workcell, 40U);
  saved.state.blocks.edit().push_back(block);
  EXPECT_GT(saved_cell_to_json(saved).dump().size() - empty - in_workcell, 40U);
}

// --- Invalid saved cells.

TEST(SavedCellJson, RejectsMissingAndUnknownMembers) {
  EXPECT_EQ(wrong_in(Json::object()), (Strings{"/robot_hash", "/workcell", "/state"}));
  EXPECT_EQ(wrong_in(5), Strings{""});
  Json json = at_home_json();
  for (const auto& [name, value] : json["state"].items()) {
    Json without = at_home_json();
    without["state"].erase(name);
    EXPECT_EQ(wrong_in(without), Strings{"/state/" + name});
  }
  json["state"]["speed"] = 1;
  EXPECT_EQ(wrong_in(json), Strings{"/state/speed"});
}

struct Broken {
  const char* pointer;
  Json value;
};

TEST(SavedCellJson, ReportsAnInvalidValueWithItsPointer) {
  const Broken all[] = {
      {"/robot_hash", 5},
      {"/workcell/blocks/0/size/1", -1},
      {"/workcell/length_unit", "ell"},
      {"/state/tick", -1},
      {"/state/tick", 9007199254740992.0},
      {"/state/tick", 1.5},
      {"/state/tick", nullptr},
      {"/state/motors/0/count", (1 << 30) + 1},
      {"/state/motors/1/count", -(1 << 30) - 1},
      {"/state/motors/1/count", 1e300},
      {"/state/motors/2/phase", 1000},
      {"/state/motors/2/phase", -1},
      {"/state/motors/3/error", 128},
      {"/state/motors/3/error", -129},
      {"/state/motors/4/speed", 0},
      {"/state/motors/4/speed", 256},
      {"/state/motors/5/blocked", "yes"},
      {"/state/motors/7/switch_closed", 0},
      {"/state/motors", Json::array()},
      {"/state/stall", nullptr},
      {"/state/display/view", {0, 0, 0}},
      {"/state/display/view/0", 10},
      {"/state/display/period_half_s", 0},
      {"/state/display/status_option", 7},
      {"/state/io/inputs", 256},
      {"/state/io/auxiliary", 4},
      {"/state/blocks/0/size_um/0", 0},
      {"/state/blocks/0/size_um/2", 100'000'001},
      {"/state/blocks/0/centroid_um/1", 2'000'000'001},
      {"/state/blocks/0/yaw_udeg", -180'000'000},
      {"/state/blocks/1/color", 16},
      {"/state/blocks/1/name", at_home().state.blocks[0].name},
      {"/state/tip_path/oldest", 1},
      {"/state/tip_path/oldest", 4096},
      {"/state/tip_path/points", {{1, 2}}},
      {"/state/tip_path/points", Json(4097, Json{1, 2, 3})},
  };
  for (const Broken& broken : all) {
    Json json = at_home_json();
    json[Json::json_pointer(broken.pointer)] = broken.value;
    const Strings wrong = wrong_in(json);
    ASSERT_FALSE(wrong.empty()) << broken.pointer << broken.value;
    EXPECT_TRUE(wrong.front().starts_with(broken.pointer)) << wrong.front();
  }
}

TEST(SavedCellJson, RejectsAnInvalidHeldBlock) {
  Json json = at_home_json();
  const std::size_t blocks = json["state"]["blocks"].size();
  json["state"]["held"] = {
      {"block", blocks}, {"quarter_turns", 0}, {"grasped_at", {0, 0, 0, 0, 0, 0, 0, 0}}};
  EXPECT_EQ(wrong_in(json), Strings{"/state/held/block"});
  json["state"]["held"]["block"] = blocks - 1;
  EXPECT_EQ(wrong_in(json), Strings{});
  json["state"]["held"]["quarter_turns"] = 4;
  json["state"]["held"]["grasped_at"][7] = 1e10;
  EXPECT_EQ(wrong_in(json), (Strings{"/state/held/quarter_turns", "/state/held/grasped_at/7"}));
}

TEST(SavedCellJson, RejectsTooManyBlocks) {
  Json json = at_home_json();
  Json block = json["state"]["blocks"][0];
  Json blocks = Json::array();
  for (std::size_t i = 0; i <= kMaxBlocks; ++i) {
    block["name"] = std::to_string(i);
    blocks.push_back(block);
  }
  json["state"]["blocks"] = blocks;
  EXPECT_EQ(wrong_in(json), Strings{"/state/blocks"});
}

TEST(SavedCellJson, WarningsAreNotErrors) {
  SavedCell saved = at_home();
  saved.workcell.blocks.edit()[0].centroid_um = saved.workcell.blocks[1].centroid_um;
  const FileReading<SavedCell> reading = read_again(saved);
  EXPECT_TRUE(reading.findings.empty()) << "warnings are dropped";
  EXPECT_TRUE(reading.value);
}

}  // namespace
}  // namespace xr3
