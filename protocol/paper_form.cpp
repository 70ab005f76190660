#include "protocol/paper_form.hpp"

#include <utility>

#include "protocol/json_source.hpp"
#include "protocol/paper_form_lines.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kItemsOfAxes = 1;
constexpr std::size_t kItemsOfWorkspace = 3;

DataKind kind_of(const paper::Lines& lines) {
  const std::size_t items = lines.data.empty() ? 0 : lines.data.front().items.size();
  if (items == kItemsOfAxes) return DataKind::kRobot;
  return items == kItemsOfWorkspace ? DataKind::kWorkcell : DataKind::kUnknown;
}

CheckResult unknown_result(const std::string& file, const paper::Lines& lines) {
  CheckResult result;
  result.findings.push_back({Severity::kError, file,
                             lines.data.empty() ? lines.end : lines.data.front().line, 0, "",
                             lines.data.empty() ? "no numbers" : "neither a robot nor a workcell",
                             "a robot, which begins with its number of axes, or a workcell, which "
                             "begins with its workspace, X Y Z"});
  return result;
}

template <class Reading>
CheckResult result_of(DataKind kind, Reading& reading) {
  CheckResult result;
  result.kind = kind;
  result.findings = std::move(reading.findings);
  return result;
}

}  // namespace

bool is_json_form(std::string_view text) {
  const std::string data = without_comment_lines(text);
  const std::size_t first = data.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (data[first] == '{' || data[first] == '[');
}

CheckResult check_either_form(std::string_view text, const std::string& file, Profile profile,
                              const Robot* robot) {
  if (is_json_form(text)) return check_text(text, file, profile, robot);
  const paper::Lines lines = paper::split(text, file);
  if (kind_of(lines) == DataKind::kRobot) {
    RobotReading reading = read_paper_robot(text, file);
    CheckResult result = result_of(DataKind::kRobot, reading);
    result.robot = std::move(reading.robot);
    if (result.robot) result.summary = robot_summary(*result.robot, profile);
    return result;
  }
  if (kind_of(lines) == DataKind::kWorkcell) {
    WorkcellReading reading = read_paper_workcell(text, file, robot);
    CheckResult result = result_of(DataKind::kWorkcell, reading);
    result.workcell = std::move(reading.workcell);
    if (result.workcell) result.summary = workcell_summary(*result.workcell);
    return result;
  }
  return unknown_result(file, lines);
}

}  // namespace xr3
