// The messages of the machine, the camera and events; and the times of messages.
#include "protocol/foxglove/messages.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>

#include "core/kinematics.hpp"
#include "protocol/foxglove/topics.hpp"
#include "protocol/json/document.hpp"
#include "tests/support/rig.hpp"

namespace xr3::foxglove {
namespace {

using test::Rig;

TEST(FoxgloveTime, CountsFromTheStartOfTheEpoch) {
  EXPECT_EQ(since_epoch(0), 0U);
  EXPECT_EQ(since_epoch(1500), 1'500'000'000U);
}

TEST(FoxgloveTime, ATimelineLaysEpochsOneAfterTheOther) {
  Timeline timeline;
  EXPECT_EQ(timeline.at(3, 10), since_epoch(10));
  EXPECT_EQ(timeline.at(3, 500), since_epoch(500));
  EXPECT_EQ(timeline.at(4, 0), since_epoch(501));
  EXPECT_EQ(timeline.at(4, 20), since_epoch(521));
  EXPECT_EQ(timeline.at(5, 9000), since_epoch(522));
}

/// The product of the transforms from the base to the tool.
Transform tool_in(const Json& message) {
  Transform pose = Transform::Identity();
  for (const Json& each : message["transforms"]) {
    const Json& t = each["translation"];
    const Json& q = each["rotation"];
    Eigen::Affine3d step = Eigen::Affine3d::Identity();
    step.linear() = Eigen::Quaterniond(q["w"], q["x"], q["y"], q["z"]).toRotationMatrix();
    step.translation() << 1000 * t["x"].get<double>(), 1000 * t["y"].get<double>(),
        1000 * t["z"].get<double>();
    pose = pose * step.matrix();
    if (each["child_frame_id"] == "tool") return pose;
  }
  return Transform::Zero();
}

TEST(FoxgloveTransforms, LeadToTheToolOfEachRobot) {
  for (const std::string& name : test::kShippedRobots) {
    Rig rig(test::model_of(test::robot_named(name)));
    const auto links = scene_links(rig.model());
    for (const char label : {'F', 'E', 'D', 'C'}) {
      rig.move(label, -30);
      rig.pass(200);
      const auto message = Json::parse(transforms_text(links, rig.model(), rig.state(), 0));
      const Transform tool =
          tool_transform(rig.model(), positions(rig.model(), rig.state().motors));
      EXPECT_LT((tool_in(message) - tool).norm(), 1e-4) << name;
    }
  }
}

TEST(FoxgloveTransforms, HaveTimeAndFrames) {
  const ModelPtr model = test::rhino();
  const auto message = Json::parse(
      transforms_text(scene_links(*model), *model, initial_state(*model), 2'000'000'001));
  EXPECT_EQ(message["transforms"][0]["timestamp"].dump(), R"({"sec":2,"nsec":1})");
  EXPECT_EQ(message["transforms"][0]["parent_frame_id"], "base");
  EXPECT_EQ(message["transforms"][0]["child_frame_id"], "link_F");
}

TEST(FoxgloveState, HasNumbersAndNoNull) {
  Rig rig;
  rig.move('F', 20);
  rig.pass(50);
  EXPECT_EQ(state_text(rig.model(), rig.state(), 2).find("null"), std::string::npos);
  const auto message = Json::parse(state_text(rig.model(), rig.state(), 2));
  EXPECT_EQ(message["tick"], 50);
  EXPECT_EQ(message["epoch"], 2);
  EXPECT_EQ(message["moving"], true);
  EXPECT_EQ(message["stalled"], "");
  EXPECT_EQ(message["joints"]["F"]["count"], rig.count('F'));
  EXPECT_EQ(message["joints"]["F"]["error"], rig.error('F'));
  EXPECT_EQ(message["joints"]["A"]["value"], 50.8);
  EXPECT_EQ(message["opening_mm"], 50.8);
}

CellEvent event(CellNote note) { return {0, 1500, std::nullopt, std::move(note)}; }

TEST(FoxgloveLog, HasLevelNameAndSentence) {
  const ModelPtr model = test::rhino();
  const auto stalled = Json::parse(
      log_text(event(EventBody(Stalled{Stall::kWorkSurface})), *model, since_epoch(1500)));
  EXPECT_EQ(stalled["level"], 4);
  EXPECT_EQ(stalled["name"], "stalled/work_surface");
  EXPECT_EQ(stalled["timestamp"].dump(), R"({"sec":1,"nsec":500000000})");
  const auto warning = Json::parse(
      log_text(event(EventBody(Warning{WarningCode::kNoSuchJoint, 'G', 0, 0, ""})), *model, 0));
  EXPECT_EQ(warning["level"], 3);
  const auto homed = Json::parse(log_text(event(EventBody(Homed{})), *model, 0));
  EXPECT_EQ(homed["level"], 2);
  EXPECT_EQ(homed["name"], "homed");
  EXPECT_EQ(homed["message"], "soft home by a call");
}

TEST(FoxgloveImage, IsAFileInBase64) {
  EXPECT_EQ(image_text("aGk=", 0),
            R"({"timestamp":{"sec":0,"nsec":0},"frame_id":"base","data":"aGk=","format":"png"})");
}

/// Checks that each value is of a type that its schema names, and that no member is unknown, but
/// for lists that are always empty.
void expect_valid(const Json& value, const Json& schema, const std::string& where) {
  const auto type = schema["type"].get<std::string>();
  if (type == "object") {
    ASSERT_TRUE(value.is_object()) << where;
    for (const auto& [name, member] : value.items()) {
      if (schema["properties"].contains(name))
        expect_valid(member, schema["properties"][name], where + "/" + name);
      else
        EXPECT_TRUE(member.is_array() && member.empty()) << where << "/" << name;
    }
    for (const auto& [name, member] : schema["properties"].items())
      EXPECT_TRUE(value.contains(name)) << where << "/" << name;
  } else if (type == "array") {
    ASSERT_TRUE(value.is_array()) << where;
    for (const Json& each : value) expect_valid(each, schema["items"], where + "/0");
  } else if (type == "string") {
    EXPECT_TRUE(value.is_string()) << where;
  } else if (type == "boolean") {
    EXPECT_TRUE(value.is_boolean()) << where;
  } else {
    EXPECT_TRUE(type == "number" ? value.is_number() : value.is_number_integer()) << where;
  }
}

TEST(FoxgloveSchemas, DescribeTheMessages) {
  const ModelPtr model = test::model_of(test::robot_named("rhino-xr3-accessories"));
  const State state = initial_state(*model);
  const auto check = [&](Topic topic, const std::string& message) {
    expect_valid(Json::parse(message), Json::parse(schema_text(topic, *model)), "");
  };
  check(Topic::kTransforms, transforms_text(scene_links(*model), *model, state, 0));
  check(Topic::kState, state_text(*model, state, 0));
  check(Topic::kEvents, log_text(event(EventBody(Homed{})), *model, 0));
  check(Topic::kCamera, image_text("", 0));
}

}  // namespace
}  // namespace xr3::foxglove
