#include "cli/exec/expectation.hpp"

#include <algorithm>
#include <regex>

#include "protocol/goals/judge.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {

std::string Expectation::trouble_of(const RunReport& report) const {
  switch (kind_) {
    case ExpectationKind::kAllGoals: return report.is_passed() ? "" : "it does not meet all goals";
    case ExpectationKind::kNoPoints:
      return points_of(report.goals) == 0
                 ? ""
                 : "it gets " + std::to_string(points_of(report.goals)) + " points";
    case ExpectationKind::kStated: break;
  }
  if (is_as_stated(report)) return "";
  return "the judge does not find, as its first line states, " + what_ +
         (part_.empty() ? "" : ": " + part_);
}

bool Expectation::is_as_stated(const RunReport& report) const {
  if (part_.empty()) return name_of(report.outcome) == what_;
  return std::ranges::any_of(report.goals, [this](const GoalResult& goal) {
    return goal.kind == what_ && !goal.is_met && goal.found.find(part_) != std::string::npos;
  });
}

Expectation stated_expectation(const std::filesystem::path& program) {
  const std::string text = read_file(program).text;
  const std::string line = text.substr(0, text.find_first_of("\r\n"));
  static const std::regex form(R"(.*\bexpects: (\w+)(?:: (.*\S))?\s*)");
  std::smatch match;
  if (!std::regex_match(line, match, form))
    throw FileError(program.string() +
                    ":1: the first line does not say what the judge must find; write a comment "
                    "such as # expects: tip: it was at, with the kind of a goal, or # expects: "
                    "failed, or # expects: time_up");
  return Expectation::stated(match[1], match[2]);
}

}  // namespace xr3
