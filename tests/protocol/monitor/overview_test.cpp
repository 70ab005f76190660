// The objects of the channel `overview`.
#include "protocol/monitor/overview.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/home.hpp"
#include "tests/support/models.hpp"

namespace xr3::monitor {
namespace {

CellSummary some_summary() {
  const ModelPtr model = test::rhino();
  CellSummary cell = machine_summary(*model, initial_state(*model));
  cell.name = "7";
  return cell;
}

TEST(Overview, ShowsAMachine) {
  EXPECT_EQ(text_of(summary_json(some_summary())),
            R"({"name":"7","robot":"Rhino XR-3","robot_port":null,"lines":0,"peer":null,)"
            R"("owner":null,"moving":false,"stalled":null,"holding":null,)"
            R"("recording_failed":false,"last_input_tick":null,"epoch":0,"tick":0,)"
            R"("joints":[0.0,-90.0,90.0,0.0,-90.0],"tool":50.8,)"
            R"("paused":false,"frozen":false,"coming_back":false,"viewers":0,)"
            R"("last_input_at":null,)"
            R"("last_command":null,"stalled_at":null,"last_warning":null,"goals":null,)"
            R"("points":null})");
}

TEST(Overview, ShowsWhatALessonNeeds) {
  CellSummary cell = some_summary();
  cell.last_input_at = 7'000;
  cell.last_command = {"E?", 31, true};
  cell.stalled_at = 8'000;
  cell.last_warning = {"unknown byte", 9'000, 2};
  cell.goals = {true, false};
  cell.points = {1, 3};
  const Json shown = summary_json(cell);
  EXPECT_EQ(shown["last_input_at"], 7'000);
  EXPECT_EQ(text_of(shown["last_command"]), R"({"text":"E?","count":31,"has_reply":true})");
  EXPECT_EQ(shown["stalled_at"], 8'000);
  EXPECT_EQ(text_of(shown["last_warning"]), R"({"text":"unknown byte","at":9000,"count":2})");
  EXPECT_EQ(text_of(shown["goals"]), "[true,false]");
  EXPECT_EQ(text_of(shown["points"]), "[1,3]");
  EXPECT_TRUE(is_news(some_summary(), cell));
}

TEST(Overview, TimeAloneIsNoNews) {
  CellSummary now = some_summary();
  now.tick = 5;
  EXPECT_FALSE(is_news(some_summary(), now));
  now.has_recording_failed = true;
  EXPECT_TRUE(is_news(some_summary(), now));
  now.has_recording_failed = false;
  now.lines = 1;
  EXPECT_TRUE(is_news(some_summary(), now));
}

TEST(Overview, AMessageHasChangesAndClosedCells) {
  EXPECT_EQ(
      *overview_message(4, 77, false, {"{}", "{}"}, {"c1", "c2"}),
      R"({"op":"overview","seq":4,"now":77,"whole":false,"cells":[{},{}],"closed":["c1","c2"]})");
  EXPECT_EQ(*overview_message(1, 77, true, {}, {}),
            R"({"op":"overview","seq":1,"now":77,"whole":true,"cells":[],"closed":[]})");
}

TEST(Overview, ASlotHasOneMessage) {
  ChannelStats stats;
  OverviewSubscription sub(2'000, stats);
  EXPECT_EQ(sub.next_output(), nullptr);
  sub.offer(overview_message(3, 77, true, {}, {}), 3, 60);
  EXPECT_TRUE(sub.is_waiting());
  EXPECT_EQ(sub.seen(), 3);
  EXPECT_FALSE(sub.is_due(89));
  EXPECT_TRUE(sub.is_due(90)) << "half a second later";
  EXPECT_NE(sub.next_output(), nullptr);
  EXPECT_FALSE(sub.is_waiting());
  EXPECT_EQ(stats.sent, 1U);
  sub.offer(overview_message(4, 77, false, {}, {}), 4, 200);
  sub.restart();
  EXPECT_FALSE(sub.is_waiting());
  EXPECT_EQ(sub.seen(), 0);
}

}  // namespace
}  // namespace xr3::monitor
