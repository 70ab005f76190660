#include "protocol/check/check_report.hpp"

#include <utility>

#include "protocol/files/faults.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/summary.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {
namespace {

/// The result of a file that has been read; its value goes to `member`.
template <class V, class Summary>
CheckResult result_of(DataKind kind, FileReading<V> reading, std::optional<V> CheckResult::*member,
                      const Summary& summary_of) {
  CheckResult result;
  result.kind = kind;
  result.findings = std::move(reading.findings);
  if (reading.value) result.summary = summary_of(*reading.value);
  result.*member = std::move(reading.value);
  return result;
}

std::string labels_of(const Robot& robot) {
  std::string labels(1, robot.tool.drive.label);
  for (const Joint& joint : robot.joints) labels += joint.drive.label;
  if (robot.carousel) labels += robot.carousel->drive.label;
  return labels;
}

CheckResult unknown_result(const std::string& file) {
  CheckResult result;
  result.findings.push_back(
      {Severity::kError, file, 1, 0, "",
       "neither a robot nor a workcell, faults, goals or an exercise",
       std::string(description_of(DataKind::kRobot)) + "; " + description_of(DataKind::kWorkcell) +
           "; " + description_of(DataKind::kFaults) + "; " + description_of(DataKind::kGoals) +
           "; or " + description_of(DataKind::kExercise)});
  return result;
}

}  // namespace

CheckResult robot_result(FileReading<Robot> reading, Profile profile) {
  return result_of(DataKind::kRobot, std::move(reading), &CheckResult::robot,
                   [&](const Robot& robot) { return robot_summary(robot, profile); });
}

CheckResult workcell_result(FileReading<Workcell> reading) {
  return result_of(DataKind::kWorkcell, std::move(reading), &CheckResult::workcell,
                   workcell_summary);
}

CheckResult check_text(std::string_view text, const std::string& file, Profile profile,
                       const Robot* robot) try {
  switch (kind_of(JsonSource(text, file).root())) {
    case DataKind::kRobot: return robot_result(read_robot(text, file), profile);
    case DataKind::kWorkcell: return workcell_result(read_workcell(text, file, robot));
    case DataKind::kFaults:
      return result_of(DataKind::kFaults,
                       read_faults(text, file, robot != nullptr ? labels_of(*robot) : ""),
                       &CheckResult::faults, faults_summary);
    case DataKind::kGoals:
      return result_of(DataKind::kGoals, read_goals(text, file), &CheckResult::goals,
                       goals_summary);
    case DataKind::kExercise:
      return result_of(DataKind::kExercise, read_exercise(text, file), &CheckResult::exercise,
                       exercise_summary);
    case DataKind::kUnknown: break;
  }
  return unknown_result(file);
} catch (const DataError& error) {
  CheckResult result;
  result.findings = error.findings();
  return result;
}

}  // namespace xr3
