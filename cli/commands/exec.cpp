#include <algorithm>
#include <set>
#include <utility>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/exec/exercise.hpp"
#include "cli/exec/hide.hpp"
#include "cli/exec/kept_transcripts.hpp"
#include "cli/exec/pool.hpp"
#include "server/files/atomic_write.hpp"
#include "server/log.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

std::string program_title(const std::vector<std::string>& command) {
  std::string title;
  for (const std::string& each : command) title += (title.empty() ? "" : " ") + each;
  return title;
}

std::vector<RunReport> run_all(const ExecCommand& command, const Exercise& exercise) {
  const auto count = static_cast<std::size_t>(command.exec.repeat);
  RunPlace place{program_title(command.exec.command),
                 command.exec.command,
                 "",
                 command.exec.out,
                 command.server.record,
                 0,
                 "",
                 0};
  if (count == 1) return {exercise.run(place)};
  const KeptTranscripts kept;
  const auto run = [&](std::size_t index) {
    RunPlace its = place;
    its.transcripts = &kept;
    its.run = index + 1;
    its.job = index;
    if (!its.folder.empty()) its.folder += "/" + folder_of_run(its.run);
    return to_json(exercise.run(its));
  };
  std::vector<RunReport> reports;
  const auto texts =
      in_processes(count, usual_jobs(), exercise.run_limit(), run, [](std::size_t) {});
  for (std::size_t i = 0; i < texts.size(); ++i)
    reports.push_back(report_of(texts[i], place.title, i + 1));
  if (!exercise.is_varied()) kept.compare(reports, exercise.profile());
  return reports;
}

/// The digests of the runs that have one.
std::set<std::string> transcripts(const std::vector<RunReport>& reports) {
  std::set<std::string> found;
  for (const RunReport& each : reports)
    if (!each.transcript.empty()) found.insert(each.transcript);
  return found;
}

std::size_t count_passed(const std::vector<RunReport>& reports) {
  return static_cast<std::size_t>(std::ranges::count_if(reports, &RunReport::is_passed));
}

/// Prints the reports; of several runs only those that failed in full.
void print(const std::vector<RunReport>& reports) {
  if (reports.size() == 1) {
    return print_text(to_text(reports.front()));
  }
  for (const RunReport& each : reports)
    if (!each.is_passed()) print_text("run " + std::to_string(each.run) + ":\n" + to_text(each));
  print_text(std::to_string(count_passed(reports)) + " of " + std::to_string(reports.size()) +
             " runs passed\n");
}

/// Prints how many different transcripts there are, and the first difference of two.
void print_differences(std::size_t count, const std::vector<RunReport>& reports) {
  print_text(std::to_string(count) + " different transcripts in " + std::to_string(reports.size()) +
             " runs: the program does not do the same every time\n");
  for (const RunReport& each : reports)
    if (!each.difference.empty()) print_text(each.difference + "\n");
}

void write_results(const ExecCommand& command, const std::vector<RunReport>& reports) {
  std::string json;
  for (const RunReport& each : reports) json += to_json(each);
  const ExecOptions& files = command.exec;
  if (!files.json.empty()) write_file(files.json, json);
  if (!files.junit.empty()) write_file(files.junit, to_junit(reports));
  if (!files.markdown.empty()) write_file(files.markdown, to_markdown(reports));
  if (!files.github.empty()) write_file(files.github, to_github(reports));
}

bool has_any(const std::vector<RunReport>& reports, RunOutcome outcome) {
  return std::ranges::count(reports, outcome, &RunReport::outcome) > 0;
}

}  // namespace

ExitCode run_command(const ExecCommand& command) {
  hide_from_programs();
  ignore_signals_of_writing();
  start_log(command.server.log_level, command.server.log_file);
  const Exercise exercise(command.exec, command.server);
  const std::vector<RunReport> reports = run_all(command, exercise);
  print(reports);
  write_results(command, reports);
  const std::set<std::string> found = transcripts(reports);
  const bool is_different = !exercise.is_varied() && found.size() > 1;
  if (is_different) print_differences(found.size(), reports);
  if (has_any(reports, RunOutcome::kTimeUp)) return ExitCode::kTimeUp;
  if (has_any(reports, RunOutcome::kFailed)) return ExitCode::kProgramFailed;
  if (is_different) return ExitCode::kDifferent;
  return count_passed(reports) == reports.size() ? ExitCode::kGood : ExitCode::kGoalsMissed;
}

}  // namespace xr3
