// The members of `state` messages: their structure, golden values of the robots, and rounded
// numbers.
#include "protocol/monitor/snapshot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/home.hpp"
#include "tests/support/models.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

Snapshot snapshot_of(const State& state) {
  Snapshot snapshot;
  snapshot.state = state;
  return snapshot;
}

Json shown(const Rig& rig) { return state_json(rig.model(), snapshot_of(rig.state())); }

std::string name_of(const Json::object_t::value_type& member) { return member.first; }

std::vector<std::string> names_of(const Json& object) {
  std::vector<std::string> names;
  for (const auto& member : object.get_ref<const Json::object_t&>())
    names.push_back(name_of(member));
  return names;
}

TEST(SnapshotJson, ShowsTheRhinoAtSoftHome) {
  const Json state = shown(Rig());
  EXPECT_EQ(
      state["joints"][0].dump(),
      R"({"label":"F","count":0,"error":0,"value":0.0,"unit":"deg","speed":110,"switch":false,)"
      R"("moving":false,"blocked":null})");
  EXPECT_EQ(
      state["tool"].dump(),
      R"({"label":"A","count":0,"error":0,"value":50.8,"unit":"mm","opening_mm":50.8,"speed":60,)"
      R"("switch":false,"moving":false,"blocked":null,"xyz_mm":[238.1,0.0,320.7],)"
      R"("rotation":[0.0,1.0,0.0,1.0,0.0,0.0,0.0,0.0,-1.0],)"
      R"("configuration":[238.1,0.0,320.7,0.0,0.0,-0.60653],"net_roll_deg":90.0,"holding":null})");
  EXPECT_EQ(state["switches"].dump(), R"({"I":0,"J":0})");
  EXPECT_EQ(state["io"].dump(),
            R"({"inputs":[false,false,false,false,false,false,false,false],)"
            R"("outputs":[false,false,false,false,false,false,false,false],"aux":[false,false]})");
}

TEST(SnapshotJson, ShowsThePhysicalController) {
  Snapshot snapshot = snapshot_of(initial_state(*test::rhino()));
  snapshot.device = {"/dev/ttyUSB0", true, false, 7, 2};
  const std::string expected =
      R"({"path":"/dev/ttyUSB0","open":true,"engaged":false,"bytes_out":7,"bytes_in":2})";
  EXPECT_EQ(state_json(*test::rhino(), snapshot)["device"].dump(), expected);
  EXPECT_EQ(StateEncoder().encode(*test::rhino(), snapshot).back(),
            std::pair(std::string("device"), expected));
}

TEST(SnapshotJson, TheCarouselIsTheLastOfTheJoints) {
  Rig rig(test::model_of(test::robot_named("rhino-xr3-accessories")));
  rig.travel('H', 40);
  rig.travel('G', -3);
  const Json joints = shown(rig)["joints"];
  ASSERT_EQ(joints.size(), 7U);
  EXPECT_EQ(joints[0]["label"], "G");
  EXPECT_EQ(joints[0]["value"], -1.5);
  EXPECT_EQ(joints[0]["unit"], "mm");
  EXPECT_EQ(joints[6]["label"], "H");
  EXPECT_EQ(joints[6]["value"], 12.5);
  EXPECT_EQ(joints[6]["unit"], "deg");
  EXPECT_EQ(joints[6]["switch"], true);
}

TEST(SnapshotJson, HasEveryMemberInOrder) {
  const Json state = shown(Rig());
  std::vector<std::string> names = names_of(state);
  names.emplace_back("device");  // only if there is one
  EXPECT_EQ(names, state_members());
  EXPECT_EQ(state["clock"].dump(), R"({"mode":"real","rate":1.0})");
  EXPECT_EQ(state["moving"], false);
  EXPECT_EQ(state["stalled"], nullptr);
  EXPECT_EQ(state["enabled"], true);
  EXPECT_EQ(state["model_rev"], 1);
  EXPECT_EQ(state["blocks"], Json::array());
}

TEST(SnapshotJson, JointsAreInOrderFromBaseToTip) {
  std::string labels;
  std::vector<double> values;
  const Json state = shown(Rig());
  for (const Json& joint : state["joints"]) {
    labels += joint["label"].get<std::string>();
    values.push_back(joint["value"].get<double>());
  }
  EXPECT_EQ(labels, "FEDCB");
  EXPECT_EQ(values, (std::vector<double>{0, -90, 90, 0, -90}));
}

TEST(SnapshotJson, ShowsAGoldenPose) {
  Rig rig;
  rig.stand_at({{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}});
  const Json state = shown(rig);
  EXPECT_EQ(state["tool"]["xyz_mm"].dump(), "[247.935,92.31,293.737]");
  EXPECT_EQ(state["tool"]["configuration"].dump(),
            "[247.935,92.31,293.737,0.03669,0.01366,-0.65808]");
  EXPECT_EQ(state["joints"][1]["value"].dump(), "-85.46");
  EXPECT_EQ(state["joints"][2]["value"].dump(), "92.27");
}

TEST(SnapshotJson, ShowsTheBlocks) {
  const Model model(test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"),
                    Profile::kPaper);
  const Json blocks = state_json(model, snapshot_of(initial_state(model)))["blocks"];
  ASSERT_EQ(blocks.size(), 5U);
  EXPECT_EQ(blocks[0].dump(),
            R"({"name":"red","xyz_mm":[262.0,0.0,20.0],"yaw_deg":90.0,"held":false})");
}

TEST(SnapshotJson, AHeldBlockMovesWithTheTool) {
  const Model model(test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"),
                    Profile::kPaper);
  State state = initial_state(model);
  state.motor(0).count = 90;  // the base, turned since the grasp
  state.held = Held{0, 1, {}};
  const Json json = state_json(model, snapshot_of(state));
  EXPECT_EQ(json["tool"]["holding"], "red");
  EXPECT_EQ(json["blocks"][0]["held"], true);
  EXPECT_EQ(json["blocks"][1]["held"], false);
  EXPECT_EQ(json["blocks"][0]["yaw_deg"].dump(), "110.421");
  const double x = 238.1 * std::cos(20.421 * kPi / 180);
  EXPECT_NEAR(json["blocks"][0]["xyz_mm"][0].get<double>(), x, 0.001);
}

TEST(SnapshotJson, ShowsAMovingMotor) {
  Rig rig;
  rig.move('E', 50);
  rig.pass(100);
  const Json state = shown(rig);
  EXPECT_EQ(state["moving"], true);
  EXPECT_EQ(state["joints"][1]["moving"], true);
  EXPECT_EQ(state["joints"][0]["moving"], false);
  EXPECT_EQ(state["joints"][1]["count"], 11);
  EXPECT_EQ(state["joints"][1]["error"], 39);
}

TEST(SnapshotJson, AMotorAtItsLimitIsBlocked) {
  Rig rig(test::roomy_rhino());
  rig.move('A', -100);
  rig.settle();
  const Json state = shown(rig);
  EXPECT_EQ(state["tool"]["blocked"], "limit");
  EXPECT_EQ(state["tool"]["moving"], false);
  EXPECT_EQ(state["moving"], false);
}

TEST(SnapshotJson, AStalledRobotDoesNotMove) {
  Rig rig;
  State state = rig.state();
  state.stall = Stall::kProtectedRegion;
  state.motor(1).error = 5;
  const Json json = state_json(rig.model(), snapshot_of(state));
  EXPECT_EQ(json["stalled"], "protected_region");
  EXPECT_EQ(json["joints"][1]["moving"], false);
  EXPECT_EQ(json["moving"], false);
  state.stall = Stall::kWorkSurface;
  EXPECT_EQ(state_json(rig.model(), snapshot_of(state))["stalled"], "work_surface");
}

TEST(SnapshotJson, SwitchesEqualTheRepliesOfTheLine) {
  for (const Profile profile : {Profile::kPaper, Profile::kMark3}) {
    Rig rig(test::rhino(profile));
    rig.stand_at({{'E', -40}});
    const Json state = shown(rig);
    EXPECT_EQ(state["joints"][1]["switch"], true);  // closed is true in every profile
    EXPECT_EQ(state["joints"][0]["switch"], false);
    EXPECT_EQ(state["switches"]["I"], profile == Profile::kPaper ? 4 : 63 - 4);
    EXPECT_EQ(state["switches"]["J"], profile == Profile::kPaper ? 0 : 48);
  }
}

TEST(SnapshotJson, ShowsDigitalLinesByIndex) {
  Rig rig;
  State state = rig.state();
  state.io = {0x01, 0x82, 0x02};
  const Json io = state_json(rig.model(), snapshot_of(state))["io"];
  EXPECT_EQ(io["inputs"].dump(), "[true,false,false,false,false,false,false,false]");
  EXPECT_EQ(io["outputs"].dump(), "[false,true,false,false,false,false,false,true]");
  EXPECT_EQ(io["aux"].dump(), "[false,true]");
}

TEST(SnapshotJson, ShowsSlidingJointsAndAngularJaws) {
  const Json adept = shown(Rig(test::model_of(test::robot_named("adept-one"))));
  EXPECT_EQ(adept["joints"][2]["unit"], "mm");
  EXPECT_EQ(adept["joints"][2]["value"].dump(), "100.0");
  const Json intelledex = shown(Rig(test::model_of(test::robot_named("intelledex-660"))));
  EXPECT_EQ(intelledex["tool"]["unit"], "deg");
  EXPECT_EQ(intelledex["tool"]["value"].dump(), "40.0");
  EXPECT_EQ(intelledex["tool"]["opening_mm"].dump(), "41.042");
}

TEST(SnapshotJson, AFarRollStillHasANumericConfiguration) {
  Rig rig(test::roomy_rhino());
  State state = rig.state();
  state.motor(4).count = 1'150'000;
  const Json json = state_json(rig.model(), snapshot_of(state));
  for (const Json& value : json["tool"]["configuration"]) {
    EXPECT_TRUE(value.is_number()) << value;
  }
}

TEST(SnapshotJson, HasOnlyTheSelectedMembers) {
  const Json state = shown(Rig());
  EXPECT_EQ(chosen(state, std::nullopt), state);
  EXPECT_EQ(chosen(state, Fields{{"stalled", "moving"}}).dump(),
            R"({"stalled":null,"moving":false})");
  EXPECT_EQ(chosen(state, Fields{{"tick", "op"}}).dump(), "{}");
  const Rig rig;
  for (const Fields& fields : {Fields{{"stalled", "moving", "stalled"}}, Fields{{"op"}}, Fields{}})
    EXPECT_EQ(state_json(rig.model(), snapshot_of(rig.state()), fields), chosen(state, fields));
  EXPECT_EQ(chosen(state, Fields{{}}).dump(), "{}");
}

// Blocks that move, that are taken up, and that come and go: the texts are those of state_json().
TEST(StateEncoder, EncodesWhatHasChanged) {
  const Model model(test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"),
                    Profile::kPaper);
  StateEncoder encoder;
  const auto expect_same = [&](const State& state) {
    const Snapshot snapshot = snapshot_of(state);
    const Json json = state_json(model, snapshot);
    const MemberTexts texts = encoder.encode(model, snapshot);
    ASSERT_EQ(texts.size(), json.size());
    for (const auto& [name, text] : texts) EXPECT_EQ(text, json.at(name).dump()) << name;
  };
  State state = initial_state(model);
  expect_same(state);
  state.blocks.edit()[1].centroid_um.x += 1000;
  expect_same(state);
  state.held = Held{1, 1, {}};
  state.motor(0).count = 90;
  expect_same(state);
  state.held.reset();
  state.blocks.edit().pop_back();
  expect_same(state);
  state.blocks = {};
  expect_same(state);
}

TEST(SnapshotJson, ShowsTheExactRate) {
  EXPECT_EQ(clock_json(ClockMode::kManual, {1'000}).dump(), R"({"mode":"manual","rate":0.001})");
  EXPECT_EQ(clock_json(ClockMode::kReal, {100'000}).dump(), R"({"mode":"real","rate":0.1})");
  EXPECT_EQ(clock_json(ClockMode::kReal, kFastest).dump(), R"({"mode":"real","rate":100000.0})");
}

TEST(Rounded, HasNoNoiseAndNoMinusZero) {
  EXPECT_EQ(Json(rounded(0.1 + 0.2, 3)).dump(), "0.3");
  EXPECT_EQ(Json(rounded(-0.0, 3)).dump(), "0.0");
  EXPECT_EQ(Json(rounded(-0.00001, 4)).dump(), "0.0");
  EXPECT_EQ(Json(rounded(-1.0004, 3)).dump(), "-1.0");
  EXPECT_EQ(Json(rounded(-1.0006, 3)).dump(), "-1.001");
  EXPECT_EQ(rounded(1e300, 5), 1e300);
  EXPECT_EQ(rounded(std::numeric_limits<double>::quiet_NaN(), 3), 0.0);
  EXPECT_EQ(rounded(-std::numeric_limits<double>::infinity(), 3),
            -std::numeric_limits<double>::max());
}

TEST(Rounded, WritesAtMostTheGivenDigits) {
  for (int i = -200'000; i <= 200'000; ++i) {
    const double noisy = i * 0.0007 + 1e-9;
    const std::string text = Json(rounded(noisy, 3)).dump();
    ASSERT_LE(text.size() - text.find('.') - 1, 3U) << text;
    ASSERT_NEAR(std::stod(text), noisy, 0.00051);
  }
}

}  // namespace
}  // namespace xr3
