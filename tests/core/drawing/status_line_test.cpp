#include "core/drawing/status_line.hpp"

#include <gtest/gtest.h>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

struct StatusRow {
  int option;
  const char* line;
};

std::string line_of(const test::Rig& rig, int option) {
  State state = rig.state();
  state.display.status_option = option;
  return status_line(rig.model(), state);
}

TEST(StatusLine, ShowsSevenOptionsAtTheSoftHome) {
  const test::Rig rig;
  const StatusRow rows[] = {
      {0, ""},
      {1, "238.1  0.0  320.7  0.0000  0.0000  -0.6065"},
      {2, "F 0.0  E -90.0  D 90.0  C 0.0  B -90.0  A 50.8"},
      {3, "F 0  E 0  D 0  C 0  B 0  A 0"},
      {4, "F 0  E 0  D 0  C 0  B 0  A 0"},
      {5, "F open  E open  D open  C open  B open  A open"},
      {6, "50.8 mm open, holds nothing"},
  };
  for (const StatusRow& row : rows) EXPECT_EQ(line_of(rig, row.option), row.line) << row.option;
}

TEST(StatusLine, DistinguishesCountersEncodersAndSwitches) {
  test::Rig rig;
  rig.stand_at({{'F', 30}, {'E', -40}});
  rig.move('E', 5);
  rig.move('D', -7);
  EXPECT_EQ(line_of(rig, 3), "F 0  E 5  D -7  C 0  B 0  A 0");
  EXPECT_EQ(line_of(rig, 4), "F 30  E -40  D 0  C 0  B 0  A 0");
  EXPECT_EQ(line_of(rig, 5), "F closed  E closed  D open  C open  B open  A open");
}

TEST(StatusLine, NamesTheHeldBlock) {
  test::Rig rig(std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                              test::workcell_named("rhino-xr3"), Profile::kPaper));
  rig.stand_at({{'E', 449}, {'D', -625}});
  rig.move('A', 100);
  rig.settle();
  EXPECT_EQ(line_of(rig, 6), "32.5 mm open, holds red");
}

TEST(StatusLine, IsSelectedByACommand) {
  test::Rig rig;
  rig.execute(SelectStatus{6});
  EXPECT_EQ(status_line(rig.model(), rig.state()), "50.8 mm open, holds nothing");
}

}  // namespace
}  // namespace xr3
