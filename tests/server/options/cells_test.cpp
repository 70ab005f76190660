// The cells that the options of `xr3 serve` ask for.
#include "server/options/cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/options/options.hpp"

namespace xr3 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CellPlan plan(const std::string& name, std::uint16_t port) { return {name, "rhino-xr3", "", port}; }

std::string problem(const ServeOptions& options) {
  try {
    plan_cells(options);
  } catch (const CellPlanError& error) {
    return error.what();
  }
  return "";
}

TEST(Cells, OneCellIsCalledMain) {
  EXPECT_THAT(plan_cells(ServeOptions{}), ElementsAre(plan("main", 9600)));
}

TEST(Cells, NumberedCellsHaveConsecutivePorts) {
  ServeOptions options;
  options.cells = 3;
  options.robot_port = kFirstOfManyPorts;
  EXPECT_THAT(plan_cells(options), ElementsAre(plan("1", 9701), plan("2", 9702), plan("3", 9703)));
  options.robot_port = 0;
  EXPECT_THAT(plan_cells(options), ElementsAre(plan("1", 0), plan("2", 0), plan("3", 0)));
}

TEST(Cells, NamedCellsReplaceNumberedOnesOrFollowThem) {
  ServeOptions options;
  options.cells = 2;
  options.robot_port = 9701;
  options.cell_choices = {parse_cell("x=adept-one,flat.json,9999"), parse_cell("1=adept-one,")};
  EXPECT_THAT(plan_cells(options),
              ElementsAre(CellPlan{"1", "adept-one", "", 9701}, plan("2", 9702),
                          CellPlan{"x", "adept-one", "flat.json", 9999}));
}

TEST(Cells, PortsMayNotClashOrBeTooHigh) {
  ServeOptions options;
  options.cells = 2;
  options.robot_port = 65535;
  EXPECT_THAT(problem(options), HasSubstr("cell 2 would have the port 65536"));
  options.robot_port = 9600;
  EXPECT_THAT(problem(options), HasSubstr("cell 2 and the monitor would both have the port 9601"));
  options.monitor_port = 0;
  EXPECT_EQ(problem(options), "");
  options.cell_choices = {parse_cell("x=a,b,9601")};
  EXPECT_THAT(problem(options), HasSubstr("cell x and cell 2 would both have the port 9601"));
}

TEST(Cells, AreLimited) {
  ServeOptions options;
  options.cells = 3;
  options.robot_port = 0;
  options.max_cells = 2;
  EXPECT_THAT(problem(options), HasSubstr("3 cells, but --max-cells is 2"));
}

TEST(Cells, ThoseOfConnectionsAreNotPlanned) {
  ServeOptions options;
  options.is_cell_per_connection = true;
  EXPECT_EQ(plan_cells(options).size(), 0U);
  options.cell_choices = {CellChoice{"ada", "", "", {}, "", "class.csv:2"}};
  EXPECT_THAT(plan_cells(options), ElementsAre(plan("ada", 0)));
  options.cell_choices.front().port = 9800;
  EXPECT_THAT(problem(options), HasSubstr("class.csv:2: found a port for \"ada\""));
  options.cell_choices = {CellChoice{"c7", "", "", {}, "", "class.csv:2"}};
  EXPECT_THAT(problem(options), HasSubstr("class.csv:2: found the name \"c7\""));
}

TEST(Cells, AChoiceHasANameARobotAndPerhapsAWorkcellAndAPort) {
  EXPECT_EQ(parse_cell("a=rhino-xr3"), (CellChoice{"a", "rhino-xr3", "", {}}));
  EXPECT_EQ(parse_cell("A_b-9=r,w"), (CellChoice{"A_b-9", "r", "w", {}}));
  EXPECT_EQ(parse_cell("a=r,,0"), (CellChoice{"a", "r", "", std::uint16_t{0}}));
  EXPECT_EQ(parse_cell("a=r,w,9800"), (CellChoice{"a", "r", "w", std::uint16_t{9800}}));
  for (const char* bad : {"", "a", "=r", "a=", "a b=r", "a=r,w,x", "a=r,w,65536", "a=r,w,",
                          "a=r,w,1,2", "abcdefghijklmnopqrstuvwxyz0123456=r"})
    EXPECT_THROW(parse_cell(bad), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace xr3
