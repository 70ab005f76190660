// The members that a client can select are exactly those of the messages.
#include "protocol/monitor/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/home.hpp"
#include "protocol/monitor/display.hpp"
#include "protocol/monitor/event.hpp"
#include "protocol/monitor/image.hpp"
#include "protocol/monitor/model.hpp"
#include "tests/support/models.hpp"

namespace xr3::monitor {
namespace {

std::vector<std::string> names_in(const Json& members) {
  std::vector<std::string> names;
  for (const auto& [name, value] : members.items()) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> sorted_members(Channel channel) {
  std::vector<std::string> names = members_of(channel);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(MonitorFields, AreThoseOfTheMessages) {
  const ModelPtr model = test::rhino();
  const State state = initial_state(*model);
  EXPECT_EQ(sorted_members(Channel::kState),
            names_in(state_json(*model, {0, ClockMode::kReal, {}, 1, state, DeviceStatus{}})));
  EXPECT_EQ(sorted_members(Channel::kImage), names_in(image_json(Image(8, 6), Encoding::kRows)));
  EXPECT_EQ(sorted_members(Channel::kDisplay), names_in(display_json(*model, state)));
  EXPECT_EQ(sorted_members(Channel::kModel), names_in(model_json(*model, state, 1, "sha256:1")));
  EXPECT_EQ(sorted_members(Channel::kLine), names_in(wire_json(WireRecord{}, *model)));
}

TEST(MonitorFields, EventsHaveTheFieldsOfAllKinds) {
  const CellNote notes[] = {
      EventBody{MoveTaken{'E', 5, 5}},
      EventBody{MotorBlocked{'E', Blocked::kLimit, 'E', true, -15, 660, 12}},
      EventBody{SwitchChanged{'E', true, -60}},
      EventBody{Grasped{"red", {}, 0}},
      EventBody{OutputChanged{1, true}},
      EventBody{InputChanged{1, true}},
      EventBody{AuxiliaryChanged{1, true}},
      EventBody{EnabledChanged{true}},
      EventBody{FaultNews{}},
      ProblemNote{},
      LineOpenedNote{},
      LineClosedNote{},
      LineTurnNote{1},
      ContestedNote{1, 'E'},
      ClockNote{"pause", ClockMode::kManual, {}},
      ModelNote{"block_add", "red", 2},
      EpochNote{"reset", 0, 7},
      HandoverNote{},
      DeviceNote{},
      CellOpenedNote{"c1"},
      CellClosedNote{"c1"},
      NoticeNote{"Save your work"},
      RecordingNote{},
      ContinuedNote{},
  };
  Json all = Json::object();
  for (const CellNote& note : notes)
    all.update(event_json({0, 1, LineId{3}, note}, *test::rhino()));
  EXPECT_EQ(sorted_members(Channel::kEvent), names_in(all));
}

TEST(MonitorFields, FindsChannelsByName) {
  for (const std::string& name : channels()) {
    ASSERT_TRUE(channel_named(name)) << name;
    EXPECT_EQ(name_of(*channel_named(name)), name);
  }
  EXPECT_EQ(channel_named("images"), std::nullopt);
  EXPECT_FALSE(is_latest_wins(Channel::kEvent));
  EXPECT_FALSE(is_latest_wins(Channel::kLine));
  EXPECT_TRUE(is_latest_wins(Channel::kModel));
  EXPECT_FALSE(is_latest_wins(Channel::kOverview));
}

}  // namespace
}  // namespace xr3::monitor
