// The report as lines for a terminal.
#include <algorithm>
#include <array>
#include <cassert>

#include "protocol/goals/goal_text.hpp"
#include "protocol/text/printable.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {
namespace {

std::string line_of(const GoalResult& goal) {
  if (goal.is_met) return "✓ " + goal.expected + (goal.is_counted ? "\n" : " (not counted)\n");
  const std::string hint = goal.hint.empty() ? "" : "  hint: " + goal.hint + "\n";
  return "✗ " + goal.expected + ": " + goal.found + "\n" + hint;
}

/// The last line: points, simulated time, bytes, and remarks such as the seed.
std::string summary(const RunReport& report) {
  std::string text = "score " + std::to_string(points_of(report.goals)) + " of " +
                     std::to_string(max_points_of(report.goals)) + "; " +
                     seconds_text(report.ticks) + " simulated s, " + std::to_string(report.bytes) +
                     " bytes";
  if (report.seed) text += "; blocks of seed " + std::to_string(*report.seed);
  if (report.has_control) text += "; the program had control of the monitor port";
  return text + "\n";
}

}  // namespace

bool RunReport::is_passed() const {
  return outcome == RunOutcome::kFinished && not_counted.empty() &&
         std::all_of(goals.begin(), goals.end(),
                     [](const GoalResult& each) { return each.is_met; });
}

std::string name_of(RunOutcome outcome) {
  constexpr std::array kNames{"finished", "failed", "time_up", "not_run"};
  return kNames.at(static_cast<std::size_t>(outcome));
}

std::string title_of(const RunReport& report) {
  return report.program + (report.run > 0 ? ", run " + std::to_string(report.run) : "");
}

std::string folder_of_run(std::size_t run) {
  assert(run > 0);
  constexpr std::size_t kDigits = 3;
  const std::string number = std::to_string(run);
  return std::string(kDigits - std::min(kDigits, number.size()), '0') + number;
}

std::string to_text(const RunReport& report) {
  std::string text;
  if (!report.why.empty()) text += "✗ " + report.why + "\n";
  for (const GoalResult& each : report.goals) text += line_of(each);
  const bool is_elsewhere =
      std::any_of(report.goals.begin(), report.goals.end(), [](const GoalResult& each) {
        return !each.is_met && (each.kind == "block" || each.kind == "stacked");
      });
  if (is_elsewhere) text += report.top_view;
  if (!report.not_counted.empty()) text += "not counted: " + report.not_counted + "\n";
  return printable_lines(text + summary(report));
}

}  // namespace xr3
