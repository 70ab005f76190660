// The channel `overview`. The clock is manual except where a test says otherwise.
#include "server/service/overview.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "tests/support/monitor_fixture.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

using OverviewTest = test::MonitorFixture;

TEST_F(OverviewTest, TheOverviewShowsAllCellsAndThenChanges) {
  HostedCell& second = host_.add(test::rhino(), "second");
  host_.on_input = [this](HostedCell& cell) { service_.overview().changed(cell); };
  read(one_);
  const std::vector<Json> answers = ask(one_, R"({"op":"sub","channel":"overview"})");
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_TRUE(answers[1]["whole"]);
  EXPECT_EQ(answers[1]["cells"].size(), 2U);
  second.cell().apply(LineOpened{"test"}, wall_now());
  second.after_input();
  const Json change = wait(one_).back();
  EXPECT_FALSE(change["whole"]);
  ASSERT_EQ(change["cells"].size(), 1U);
  EXPECT_EQ(change["cells"][0]["name"], "second");
  EXPECT_EQ(change["cells"][0]["lines"], 1);
  const CellPtr kept = second.shared_from_this();
  service_.remove_cell(second);
  host_.cells.remove(second);
  kept->retire();
  EXPECT_EQ(wait(one_).back()["closed"].dump(), R"(["second"])");
}

TEST_F(OverviewTest, AtRestTheOverviewIsIdle) {
  ask(one_, R"({"op":"sub","channel":"overview"})");
  io_.restart();
  io_.run_for(700ms);
  read(one_);
  io_.restart();
  EXPECT_EQ(io_.run_for(300ms), 0U);
}

}  // namespace
}  // namespace xr3
