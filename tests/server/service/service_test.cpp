// The cell that a request concerns, and the statistics of all cells. The clock is manual except
// where a test says otherwise.
#include "server/service/service.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/monitor_fixture.hpp"

namespace xr3 {
namespace {

using MonitorServiceTest = test::MonitorFixture;

TEST_F(MonitorServiceTest, ARequestGoesToTheCellThatItNames) {
  HostedCell& second = host_.add(test::rhino(), "second");
  read(one_);
  answer(one_, R"({"op":"call","id":1,"cell":"second","fn":"reset","args":{}})");
  EXPECT_EQ(second.cell().epoch(), 1);
  EXPECT_EQ(cell_.epoch(), 0);
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"model","cell":"second"})")["cell"], "second");
  EXPECT_EQ(answer(one_, R"({"op":"get","channel":"model"})")["cell"], "main");
}

TEST_F(MonitorServiceTest, AnUnknownCellIsAnError) {
  read(one_);
  const Json error = answer(one_, R"({"op":"ping","id":4,"cell":"third"})")["error"];
  EXPECT_EQ(error["code"], "unknown_cell");
  EXPECT_EQ(error["message"], R"(there is no cell "third")");
  EXPECT_EQ(error["hint"], R"(there is "main")");
  host_.add(test::rhino(), "first");
  EXPECT_EQ(answer(one_, R"({"op":"ping","cell":"frist"})")["error"]["hint"],
            R"(there is "main" or "first"; perhaps "first" was meant)");
}

TEST_F(MonitorServiceTest, CountersAreSumsAndKeepThoseOfClosedCells) {
  HostedCell& second = host_.add(test::rhino(), "second");
  const CellPtr kept = second.shared_from_this();
  second.cell().apply(LineOpened{"test"}, wall_now());
  send("E?");
  EXPECT_EQ(service_.counters().lines_total, 2U);
  EXPECT_EQ(service_.counters().lines_open, 2U);
  service_.remove_cell(second);
  host_.cells.remove(second);
  kept->retire();
  EXPECT_EQ(service_.counters().lines_total, 2U);
  EXPECT_EQ(service_.counters().lines_open, 1U);
  EXPECT_EQ(service_.counters().cells_open, 1U);
  EXPECT_EQ(service_.counters().cells_total, 2U);
}

TEST_F(MonitorServiceTest, ManyCellsTogetherAreBoundedByTheMemory) {
  MemoryLimit limit(io_, 1, [] { return 0; });
  service_.calls().limit_memory(limit);
  read(one_);
  EXPECT_TRUE(call(one_, "snapshot_save", R"({"name":"a"})")["ok"])
      << "one cell has its own limits";
  host_.add(test::rhino(), "second");
  EXPECT_EQ(call(one_, "snapshot_save", R"({"name":"b"})")["error"]["code"], "limit");
  EXPECT_TRUE(call(one_, "reset")["ok"]);
  EXPECT_TRUE(call(one_, "snapshot_save", R"({"inline":true})")["ok"]);
}

TEST_F(MonitorServiceTest, WithoutACellOnlyTheServerAnswers) {
  host_.cells.remove(hosted_);
  OpenSession other(service_, sink_);
  const std::vector<Json> hello = read(other);
  EXPECT_TRUE(hello.at(0)["cell"].is_null());
  EXPECT_TRUE(hello.at(0)["robot"].is_null());
  EXPECT_EQ(answer(other, R"({"op":"ping","id":1})")["op"], "pong");
  EXPECT_TRUE(call(other, "describe")["value"]["tick"].is_null());
  const Json error = answer(other, R"({"op":"get","channel":"state"})")["error"];
  EXPECT_EQ(error["code"], "unknown_cell");
}

}  // namespace
}  // namespace xr3
