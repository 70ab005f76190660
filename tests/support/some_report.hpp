// Reports of runs for the tests of their forms.
#pragma once

#include "tools/report/run_report.hpp"

namespace xr3::test {

inline RunReport some_report() {
  RunReport report;
  report.program = "pick <a> & \"b\".py";
  report.goals = {
      {true, 2, "no_stall", "the robot never stalls", "", ""},
      {false, 3, "block", "block red at x 1 mm", "it is at x 2 mm | y", "look `again`"}};
  report.ticks = 1'250;
  report.bytes = 17;
  report.top_view = "a view\n";
  return report;
}

/// A program that met a goal and gets no points for it.
inline RunReport uncounted_report() {
  RunReport report = some_report();
  report.goals.pop_back();
  report.goals.front().is_counted = false;
  report.not_counted = "it did <nothing>";
  return report;
}

}  // namespace xr3::test
