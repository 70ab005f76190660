#include "server/cells/branch_cells.hpp"

#include <gtest/gtest.h>

#include <boost/asio/post.hpp>
#include <string>
#include <vector>

#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

class BranchCellsTest : public testing::Test {
 protected:
  BranchCells branches(WallNs linger) {
    return {io_, linger, [this](const CellPtr& cell) {
              closed_.push_back(cell->name());
              cell->retire();
            }};
  }
  CellPtr cell(const std::string& name) {
    return host_.add(test::rhino(), name).shared_from_this();
  }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  std::vector<std::string> closed_;
};

TEST_F(BranchCellsTest, NamesAreGivenOnce) {
  BranchCells all = branches(0);
  EXPECT_EQ(all.next_name(), "b1");
  EXPECT_EQ(all.next_name(), "b2");
}

TEST_F(BranchCellsTest, AnUnusedCellGoesAndOneWithALineStays) {
  BranchCells all = branches(0);
  const CellPtr used = cell("b1");
  used->cell().apply(LineOpened{"monitor", LineKind::kMonitor}, 0);
  all.add(used);
  all.add(cell("b2"));
  while (closed_.empty()) io_.run_one();
  EXPECT_EQ(closed_, std::vector<std::string>{"b2"});
  used->cell().apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  while (closed_.size() < 2) io_.run_one();
  EXPECT_EQ(closed_.back(), "b1");
}

TEST_F(BranchCellsTest, NothingWaitsWithoutBranches) {
  BranchCells all = branches(0);
  all.add(cell("b1"));
  while (closed_.empty()) io_.run_one();
  EXPECT_EQ(io_.run_one(), 0U) << "no timer is left";
}

TEST_F(BranchCellsTest, StopClosesNoFurtherCell) {
  BranchCells all = branches(0);
  all.add(cell("b1"));
  all.stop();
  io_.run();
  EXPECT_TRUE(closed_.empty());
}

}  // namespace
}  // namespace xr3
