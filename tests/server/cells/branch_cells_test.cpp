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
  EXPECT_EQ(all.next_name("7"), "7-b1");
  EXPECT_EQ(all.next_name("7"), "7-b2");
  EXPECT_EQ(all.next_name("main"), "main-b1") << "the number does not depend on other origins";
}

TEST_F(BranchCellsTest, NamesFitIntoTheLengthOfNames) {
  BranchCells all = branches(0);
  EXPECT_EQ(all.next_name(std::string(32, 'x')), std::string(29, 'x') + "-b1");
}

TEST_F(BranchCellsTest, ABranchOfABranchCountsForTheOrigin) {
  BranchCells all = branches(0);
  const CellPtr origin = cell("7");
  const CellPtr branch = cell("7-b1");
  all.add(branch, all.origin_of(*origin));
  all.add(cell("7-b2"), all.origin_of(*branch));
  EXPECT_EQ(all.count("7"), 2U);
  EXPECT_EQ(all.count("7-b1"), 0U);
  EXPECT_EQ(all.count("8"), 0U);
}

TEST_F(BranchCellsTest, AnUnusedCellGoesAndOneWithALineStays) {
  BranchCells all = branches(0);
  const CellPtr used = cell("b1");
  used->cell().apply(LineOpened{"monitor", LineKind::kMonitor}, 0);
  all.add(used, "main");
  all.add(cell("b2"), "main");
  while (closed_.empty()) io_.run_one();
  EXPECT_EQ(closed_, std::vector<std::string>{"b2"});
  used->cell().apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  while (closed_.size() < 2) io_.run_one();
  EXPECT_EQ(closed_.back(), "b1");
}

TEST_F(BranchCellsTest, NothingWaitsWithoutBranches) {
  BranchCells all = branches(0);
  all.add(cell("b1"), "main");
  while (closed_.empty()) io_.run_one();
  EXPECT_EQ(io_.run_one(), 0U) << "no timer is left";
}

TEST_F(BranchCellsTest, StopClosesNoFurtherCell) {
  BranchCells all = branches(0);
  all.add(cell("b1"), "main");
  all.stop();
  io_.run();
  EXPECT_TRUE(closed_.empty());
}

}  // namespace
}  // namespace xr3
