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
            R"("joints":[0.0,-90.0,90.0,0.0,-90.0],"tool":50.8})");
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
  EXPECT_EQ(*overview_message(4, false, {"{}", "{}"}, {"c1", "c2"}),
            R"({"op":"overview","seq":4,"whole":false,"cells":[{},{}],"closed":["c1","c2"]})");
  EXPECT_EQ(*overview_message(1, true, {}, {}),
            R"({"op":"overview","seq":1,"whole":true,"cells":[],"closed":[]})");
}

TEST(Overview, ASlotHasOneMessage) {
  ChannelStats stats;
  OverviewSubscription sub(2'000, stats);
  EXPECT_EQ(sub.next_output(), nullptr);
  sub.offer(overview_message(3, true, {}, {}), 3, 60);
  EXPECT_TRUE(sub.is_waiting());
  EXPECT_EQ(sub.seen(), 3);
  EXPECT_FALSE(sub.is_due(89));
  EXPECT_TRUE(sub.is_due(90)) << "half a second later";
  EXPECT_NE(sub.next_output(), nullptr);
  EXPECT_FALSE(sub.is_waiting());
  EXPECT_EQ(stats.sent, 1U);
  sub.offer(overview_message(4, false, {}, {}), 4, 200);
  sub.restart();
  EXPECT_FALSE(sub.is_waiting());
  EXPECT_EQ(sub.seen(), 0);
}

}  // namespace
}  // namespace xr3::monitor
