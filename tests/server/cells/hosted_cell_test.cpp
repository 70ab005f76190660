// Cells of a server in memory: their names and tokens, what they cost at rest, and that nothing of
// one that was closed remains.
#include "server/cells/hosted_cell.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server/net/memory_limit.hpp"
#include "server/net/wall_clock.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMaxBytesAtRest = 16 * 1024;

class HostedCellTest : public testing::Test {
 protected:
  asio::io_context io_{1};
  test::CellHost host_{io_};
};

TEST_F(HostedCellTest, IsFoundByItsName) {
  HostedCell& one = host_.add(test::rhino(), "one");
  HostedCell& two = host_.add(test::rhino(), "two");
  EXPECT_EQ(host_.cells.find("one").get(), &one);
  EXPECT_EQ(host_.cells.find("three"), nullptr);
  EXPECT_EQ(host_.cells.all().front().get(), &one);
  EXPECT_FALSE(host_.cells.is_single());
  host_.cells.remove(two);
  EXPECT_EQ(host_.cells.find("two"), nullptr);
  EXPECT_TRUE(host_.cells.is_single());
  EXPECT_EQ(host_.cells.total(), 2U);
}

TEST_F(HostedCellTest, IsFoundByItsToken) {
  host_.add(test::rhino(), "open");
  const CellPtr closed = HostedCell::make(
      host_.context, {"closed", test::rhino(), SimClock::manual(), {}, "a token of a cell"});
  host_.cells.add(closed);
  EXPECT_EQ(host_.cells.find_by_token("a token of a cell"), closed);
  EXPECT_EQ(host_.cells.find_by_token(""), nullptr);
  EXPECT_EQ(host_.cells.find_by_token("a token of a cel"), nullptr);
  host_.cells.remove(*closed);
  EXPECT_EQ(host_.cells.find_by_token("a token of a cell"), nullptr);
}

TEST_F(HostedCellTest, CostsLittleAtRest) {
  constexpr std::size_t kCells = 200;
  const ModelPtr model = test::rhino();
  const std::size_t before = allocated_bytes();
  for (std::size_t i = 0; i < kCells; ++i) {
    HostedCell& cell = host_.add(model, std::to_string(i));
    cell.add_port({4}).listen({asio::ip::make_address("127.0.0.1"), 0});
  }
  io_.poll();
  EXPECT_LE((allocated_bytes() - before) / kCells, kMaxBytesAtRest);
}

TEST_F(HostedCellTest, ARestingCellArmsNoTimer) {
  for (int i = 0; i < 3; ++i) host_.add(test::rhino(), std::to_string(i)).after_input();
  io_.run();  // returns at once
  EXPECT_EQ(io_.poll(), 0U);
}

TEST_F(HostedCellTest, NothingRemainsOfAClosedCell) {
  const ModelPtr model = test::rhino();
  const long uses = model.use_count();
  std::weak_ptr<HostedCell> last;
  for (int i = 0; i < 1000; ++i) {
    CellPtr cell = host_.add(model, std::to_string(i)).shared_from_this();
    const LineId line = cell->cell().apply(LineOpened{"test"}, wall_now()).line;
    cell->cell().apply(BytesIn{line, "E+5\rE?"}, wall_now());
    cell->cell().apply(LineClosed{line, LineCloseReason::kClientClosed}, wall_now());
    cell->after_input();
    host_.cells.remove(*cell);
    cell->retire();
    last = cell;
    cell.reset();
    EXPECT_TRUE(last.expired()) << i;
  }
  io_.restart();
  io_.poll();
  EXPECT_EQ(model.use_count(), uses);
}

TEST_F(HostedCellTest, ARetiredCellIgnoresInputs) {
  const CellPtr cell = host_.add(test::rhino()).shared_from_this();
  int acted = 0;
  host_.on_input = [&acted](HostedCell&) { ++acted; };
  cell->after_input();
  EXPECT_EQ(acted, 1);
  host_.cells.remove(*cell);
  cell->retire();
  cell->after_input();
  EXPECT_EQ(acted, 1);
  EXPECT_TRUE(cell->is_retired());
}

}  // namespace
}  // namespace xr3
