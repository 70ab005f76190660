#include "protocol/files/check_report.hpp"

#include <utility>

#include "protocol/files/faults.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/summary.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {
namespace {

CheckResult robot_result(std::string_view text, const std::string& file, Profile profile) {
  CheckResult result;
  result.kind = DataKind::kRobot;
  RobotReading reading = read_robot(text, file);
  result.findings = std::move(reading.findings);
  result.robot = std::move(reading.robot);
  if (result.robot) result.summary = robot_summary(*result.robot, profile);
  return result;
}

CheckResult workcell_result(std::string_view text, const std::string& file, const Robot* robot) {
  CheckResult result;
  result.kind = DataKind::kWorkcell;
  WorkcellReading reading = read_workcell(text, file, robot);
  result.findings = std::move(reading.findings);
  result.workcell = std::move(reading.workcell);
  if (result.workcell) result.summary = workcell_summary(*result.workcell);
  return result;
}

std::string labels_of(const Robot& robot) {
  std::string labels(1, robot.tool.drive.label);
  for (const Joint& joint : robot.joints) labels += joint.drive.label;
  if (robot.carousel) labels += robot.carousel->drive.label;
  return labels;
}

CheckResult faults_result(std::string_view text, const std::string& file, const Robot* robot) {
  CheckResult result;
  result.kind = DataKind::kFaults;
  FaultsReading reading = read_faults(text, file, robot != nullptr ? labels_of(*robot) : "");
  result.findings = std::move(reading.findings);
  result.faults = std::move(reading.plan);
  if (result.faults) result.summary = faults_summary(*result.faults);
  return result;
}

CheckResult goals_result(std::string_view text, const std::string& file) {
  CheckResult result;
  result.kind = DataKind::kGoals;
  GoalsReading reading = read_goals(text, file);
  result.findings = std::move(reading.findings);
  if (reading.list) result.summary = goals_summary(*reading.list);
  return result;
}

CheckResult unknown_result(const std::string& file) {
  CheckResult result;
  result.findings.push_back(
      {Severity::kError, file, 1, 0, "", "neither a robot nor a workcell, faults or goals",
       std::string(description_of(DataKind::kRobot)) + "; " + description_of(DataKind::kWorkcell) +
           "; " + description_of(DataKind::kFaults) + "; or " +
           description_of(DataKind::kGoals)});
  return result;
}

}  // namespace

CheckResult check_text(std::string_view text, const std::string& file, Profile profile,
                       const Robot* robot) try {
  switch (kind_of(JsonSource(text, file).root())) {
    case DataKind::kRobot: return robot_result(text, file, profile);
    case DataKind::kWorkcell: return workcell_result(text, file, robot);
    case DataKind::kFaults: return faults_result(text, file, robot);
    case DataKind::kGoals: return goals_result(text, file);
    case DataKind::kUnknown: break;
  }
  return unknown_result(file);
} catch (const DataError& error) {
  CheckResult result;
  result.findings = error.findings();
  return result;
}

}  // namespace xr3
