// The tables of a class: for a spreadsheet, and for Moodle.
#include <algorithm>
#include <optional>
#include <string_view>

#include "protocol/goals/goal_text.hpp"
#include "protocol/text/printable.hpp"
#include "tools/report/class_report.hpp"
#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

/// A field of a table: in quotes, and never a formula of a spreadsheet.
std::string field(const std::string& text) {
  const bool is_formula =
      !text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos;
  std::string result = is_formula ? "\"'" : "\"";
  for (const char c : printable_lines(text))
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string missed_text(const RunReport& report) {
  std::string text = report.why;
  for (const GoalResult& each : report.goals)
    if (!each.is_met) text += (text.empty() ? "" : "; ") + each.expected + ": " + each.found;
  if (!report.not_counted.empty())
    text += (text.empty() ? "" : "; ") + ("not counted: " + report.not_counted);
  return text;
}

/// The goals of the exercise: those of the run that has most, since one that could not be made has
/// none.
std::vector<GoalResult> goals_of(const ClassReport& report) {
  std::vector<GoalResult> goals;
  for (const Submission& each : report.submissions)
    if (each.counted().goals.size() > goals.size()) goals = each.counted().goals;
  return goals;
}

std::string csv_row(const Submission& submission, std::size_t goals) {
  const RunReport& report = submission.counted();
  std::string text = field(report.program) + "," + name_of(report.outcome) + "," +
                     std::to_string(points_of(report.goals)) + "," +
                     std::to_string(max_points_of(report.goals)) + ",";
  for (std::size_t i = 0; i < goals; ++i)
    text += (i < report.goals.size() ? std::to_string(report.goals[i].earned()) : "") + ",";
  return text + seconds_text(report.ticks) + "," + std::to_string(report.bytes) + "," +
         (report.seed ? std::to_string(*report.seed) : "") + "," +
         (submission.twin.empty() ? "" : field(submission.twin)) + "," +
         field(missed_text(report)) + "\n";
}

/// The student of a submission as Moodle names it: `Ada Lovelace_12345_assignsubmission_file`,
/// with or without the name of the file.
struct MoodleName {
  std::string student;
  std::string participant;  ///< a number
};

std::optional<MoodleName> moodle_name(const std::string& submission) {
  const std::size_t end = submission.find("_assignsubmission_");
  if (end == submission.npos || end == 0) return std::nullopt;
  const std::size_t mark = submission.rfind('_', end - 1);
  if (mark == submission.npos) return std::nullopt;
  const std::string number = submission.substr(mark + 1, end - mark - 1);
  const bool is_number = !number.empty() && number.find_first_not_of("0123456789") == number.npos;
  if (!is_number) return std::nullopt;
  return MoodleName{submission.substr(0, mark), number};
}

/// The comment for the student: HTML, a line for each goal.
std::string feedback(const RunReport& report) {
  std::string text;
  if (!report.why.empty()) text += html(report.why) + "<br>";
  for (const GoalResult& each : report.goals) {
    text += (each.is_met ? "✓ " : "✗ ") + html(each.expected);
    if (!each.is_met) text += ": " + html(each.found);
    if (!each.is_met && !each.hint.empty()) text += ". Hint: " + html(each.hint);
    text += "<br>";
  }
  if (!report.not_counted.empty()) text += "Not counted: " + html(report.not_counted) + "<br>";
  return text;
}

}  // namespace

std::string to_csv(const ClassReport& report) {
  const std::vector<GoalResult> goals = goals_of(report);
  std::string text = "\xEF\xBB\xBFsubmission,outcome,points,max_points,";
  for (std::size_t i = 0; i < goals.size(); ++i)
    text += field(std::to_string(i + 1) + ": " + goals[i].expected) + ",";
  text += "sim_seconds,bytes,seed,same_as,missed\n";
  for (const Submission& each : report.submissions) text += csv_row(each, goals.size());
  return text;
}

std::string to_moodle(const ClassReport& report) {
  std::string rows;
  for (const Submission& each : report.submissions) {
    const RunReport& run = each.counted();
    const auto name = moodle_name(run.program);
    if (!name || run.goals.empty()) continue;  // not run, or it could not be made
    rows += field("Participant " + name->participant) + "," + field(name->student) + "," +
            std::to_string(points_of(run.goals)) + "," + std::to_string(max_points_of(run.goals)) +
            "," + field(feedback(run)) + "\n";
  }
  if (rows.empty()) return "";
  return "Identifier,\"Full name\",Grade,\"Maximum Grade\",\"Feedback comments\"\n" + rows;
}

}  // namespace xr3
