// The report in the forms that other programs read.
#include <nlohmann/json.hpp>
#include <string_view>

#include "protocol/json/source.hpp"
#include "protocol/json/values.hpp"
#include "protocol/text/printable.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {
namespace {

constexpr int kSecondDecimals = 3;

Json goal_json(const GoalResult& goal) {
  return {{"kind", goal.kind},     {"met", goal.is_met},        {"counted", goal.is_counted},
          {"points", goal.points}, {"expected", goal.expected}, {"found", goal.found},
          {"hint", goal.hint}};
}

RunOutcome outcome_named(const std::string& name) {
  for (const RunOutcome each : {RunOutcome::kFinished, RunOutcome::kFailed, RunOutcome::kTimeUp})
    if (name_of(each) == name) return each;
  return RunOutcome::kNotRun;
}

/// Text in a cell of a table.
std::string cell_text(std::string_view text) {
  std::string result;
  for (const char c : printable_lines(text)) {
    if (c == '|' || c == '\\' || c == '<' || c == '`') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

}  // namespace

std::string to_json(const RunReport& report) {
  Json goals = Json::array();
  for (const GoalResult& each : report.goals) goals.push_back(goal_json(each));
  Json json = {{"program", printable_line(report.program)},
               {"outcome", name_of(report.outcome)},
               {"why", printable_line(report.why)},
               {"passed", report.is_passed()},
               {"points", points_of(report.goals)},
               {"max_points", max_points_of(report.goals)},
               {"not_counted", report.not_counted},
               {"ticks", report.ticks},
               {"wall_seconds", rounded(report.wall_s, kSecondDecimals)},
               {"bytes", report.bytes},
               {"monitor_control", report.has_control},
               {"goals", std::move(goals)},
               {"top_view", report.top_view}};
  if (!report.transcript.empty()) json["transcript"] = report.transcript;
  if (!report.difference.empty()) json["difference"] = report.difference;
  if (!report.errors.empty()) json["stderr"] = report.errors;
  if (report.seed) json["seed"] = *report.seed;
  if (report.run > 0) json["run"] = report.run;
  return printable_json(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

RunReport parse_report(const std::string& json) {
  const Json its = Json::parse(json);
  RunReport report;
  report.program = its.at("program");
  report.outcome = outcome_named(its.at("outcome"));
  report.why = its.at("why");
  for (const Json& each : its.at("goals"))
    report.goals.push_back({each.at("met"), each.at("points"), each.at("kind"), each.at("expected"),
                            each.at("found"), each.at("hint"), each.at("counted")});
  report.not_counted = its.at("not_counted");
  report.ticks = its.at("ticks");
  report.wall_s = its.at("wall_seconds");
  report.bytes = its.at("bytes");
  report.has_control = its.at("monitor_control");
  report.top_view = its.at("top_view");
  report.transcript = its.value("transcript", std::string());
  report.difference = its.value("difference", std::string());
  report.errors = its.value("stderr", std::string());
  if (its.contains("seed")) report.seed = its.at("seed").get<std::uint64_t>();
  report.run = its.value("run", std::size_t{0});
  return report;
}

std::string to_markdown(const std::vector<RunReport>& reports) {
  std::string text;
  for (const RunReport& report : reports) {
    text += "### " + cell_text(title_of(report)) +
            (report.seed ? ", blocks of seed " + std::to_string(*report.seed) : "") + ": " +
            std::to_string(points_of(report.goals)) + " of " +
            std::to_string(max_points_of(report.goals)) + "\n\n";
    for (const std::string& each : {report.why, report.difference})
      if (!each.empty()) text += "**" + cell_text(each) + "**\n\n";
    if (report.goals.empty()) continue;
    text += "| | goal | found | points |\n|---|---|---|---|\n";
    for (const GoalResult& each : report.goals)
      text += "| " + std::string(each.is_met ? "✓" : "✗") + " | " + cell_text(each.expected) +
              " | " + (each.is_counted ? cell_text(each.found) : "not counted") + " | " +
              std::to_string(each.earned()) + "/" + std::to_string(each.points) + " |\n";
    if (!report.not_counted.empty())
      text += "\nNot counted: " + cell_text(report.not_counted) + ".\n";
    text += "\n";
  }
  return text;
}

}  // namespace xr3
