// The members of `model` messages: saved as files they start an equal cell.
#include "protocol/monitor/model.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/drawing/stick_figure.hpp"
#include "core/grasp.hpp"
#include "core/home.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "tests/support/models.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

ModelPtr at_its_table(const std::string& robot) {
  return std::make_shared<const Model>(test::robot_named(robot), test::workcell_named(robot),
                                       Profile::kPaper);
}

/// The workcell that a client would save, reloaded. Throws if a finding is an error.
Workcell reloaded(const Rig& rig) {
  const Json json = model_json(rig.model(), rig.state(), 1, "sha256:0");
  return load_workcell(json["workcell"].dump(), "kept");
}

TEST(ModelJson, HasTheseMembers) {
  const Rig rig(at_its_table("rhino-xr3"));
  const Json json = model_json(rig.model(), rig.state(), 3, "sha256:9f2c");
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"rev", "robot", "workcell", "hash"}));
  EXPECT_EQ(json["rev"], 3);
  EXPECT_EQ(json["hash"], "sha256:9f2c");
  EXPECT_EQ(load_robot(json["robot"].dump(), "kept"), rig.model().robot());
  EXPECT_EQ(reloaded(rig), rig.model().workcell());
}

TEST(ModelJson, ARobotWithoutOutlinesHasThoseOfItsStickFigure) {
  Robot robot = test::robot_named("rhino-xr3");
  robot.links.clear();
  const Rig rig(test::model_of(robot));
  const Json json = model_json(rig.model(), rig.state(), 1, "");
  EXPECT_EQ(load_robot(json["robot"].dump(), "drawn"), stick_figure(robot));
}

TEST(ModelJson, HasCurrentPlacesOfBlocksToTheMicrometre) {
  test::RandomBytes random(7);
  const auto within = [&](int most) {
    return static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(2 * most))) - most;
  };
  Rig rig(at_its_table("rhino-xr3"));
  for (int round = 0; round < 500; ++round) {
    State state = rig.state();
    for (Block& block : state.blocks.edit()) {
      block.centroid_um = {within(900'000), within(900'000), within(900'000)};
      block.yaw_udeg = within(180'000'000);
    }
    rig.simulation.restore(state);
    ASSERT_EQ(reloaded(rig).blocks, state.blocks);
  }
}

// Blocks in a file are upright: a held one is saved as if released at its current place.
TEST(ModelJson, AHeldBlockHasItsCurrentPlace) {
  Rig rig(at_its_table("rhino-xr3"));
  rig.travel('E', 449);
  rig.travel('D', -625);
  rig.move('A', 127);
  rig.settle();
  rig.execute(Stop{'A'});
  ASSERT_TRUE(rig.state().held);
  rig.travel('E', -200);
  rig.travel('C', 150);
  rig.travel('F', -123);
  const std::uint32_t held = rig.state().held->block;
  const Workcell kept = reloaded(rig);
  EXPECT_NE(kept.blocks[held].centroid_um, rig.state().blocks[held].centroid_um);
  rig.move('A', -5);
  rig.settle();
  ASSERT_FALSE(rig.state().held);
  EXPECT_EQ(kept.blocks, rig.state().blocks);
}

TEST(ModelJson, EveryShippedWorkcellPassesTheCheck) {
  for (const std::string robot : {"rhino-xr3", "adept-one", "intelledex-660"}) {
    const Rig rig(at_its_table(robot));
    const Json json = model_json(rig.model(), rig.state(), 1, "sha256:0");
    const FileReading<Workcell> reading =
        read_workcell(json["workcell"].dump(), "kept", &rig.model().robot());
    EXPECT_TRUE(reading.findings.empty()) << robot;
  }
}

}  // namespace
}  // namespace xr3
