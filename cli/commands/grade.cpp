#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <system_error>
#include <utility>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/exec/exercise.hpp"
#include "cli/exec/hide.hpp"
#include "cli/exec/pool.hpp"
#include "cli/exec/submission.hpp"
#include "protocol/goals/goal_text.hpp"
#include "protocol/text/printable.hpp"
#include "protocol/text/text_stream.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"
#include "server/log.hpp"
#include "server/print.hpp"
#include "tools/report/class_report.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

/// The files of the report stand beside the folders of the submissions.
constexpr const char* kPage = "index.html";
constexpr const char* kTable = "grades.csv";
constexpr const char* kJunit = "junit.xml";

constexpr std::array kReportFiles{kPage, kTable, kJunit};

bool is_report(const fs::path& path) {
  return std::ranges::all_of(kReportFiles, [&](const char* file) {
    std::error_code no_folder;
    return fs::exists(path / file, no_folder);
  });
}

/// Whether a path is a submission, and not hidden, made by Python, or the report of a class.
bool is_submission(const fs::path& path) {
  const std::string name = path.filename().string();
  return !name.starts_with('.') && name != "__pycache__" && !is_report(path);
}

/// The submissions in the order of their names.
std::vector<fs::path> submissions_in(const std::string& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error) throw FileError(folder + ": cannot be read: " + error.message());
  std::vector<fs::path> found;
  for (const fs::directory_entry& each : entries)
    if (is_submission(each.path())) found.push_back(each.path());
  if (found.empty()) throw FileError(folder + ": there is no submission in this folder");
  std::sort(found.begin(), found.end());
  return found;
}

/// The command with the submission in place of each `{}`.
std::vector<std::string> command_for(const fs::path& submission, std::vector<std::string> command) {
  for (std::string& each : command)
    for (std::size_t at = each.find("{}"); at != std::string::npos; at = each.find("{}", at)) {
      each.replace(at, 2, submission.string());
      at += submission.string().size();
    }
  return command;
}

void require_place(const std::vector<std::string>& command) {
  const auto is_place = [](const std::string& each) { return each.find("{}") != each.npos; };
  if (std::ranges::none_of(command, is_place))
    throw FileError(
        "grade: the command has no {} where the submission belongs, as in: "
        "xr3 grade FOLDER --goals FILE --report NEW -- python3 {}");
}

void require_free_names(const std::vector<fs::path>& submissions) {
  for (const fs::path& each : submissions)
    for (const char* file : kReportFiles)
      if (each.filename() == file)
        throw FileError(each.string() +
                        ": a file of the report has this name; rename it, or move it " +
                        "out of the folder of submissions");
}

void make_report_folder(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_empty(path, error))
    throw FileError(path + ": there is something in this folder; name a new one for the report");
  fs::create_directories(path, error);
  if (error) throw FileError(path + ": cannot be made: " + error.message());
}

void print_table(const std::vector<RunReport>& reports) {
  const auto title = [](const RunReport& report) { return printable_line(report.program); };
  std::size_t width = 0;
  for (const RunReport& each : reports) width = std::max(width, title(each).size());
  TextStream table;
  for (const RunReport& each : reports)
    table << std::left << std::setw(static_cast<int>(width)) << title(each) << "  "
          << points_of(each.goals) << "/" << max_points_of(each.goals) << "  " << each.why << "\n";
  print_text(table.str());
}

}  // namespace

ExitCode run_command(const GradeCommand& command) {
  hide_from_programs();
  ignore_signals_of_writing();
  start_log(command.server.log_level, "");
  require_place(command.exec.command);
  const std::vector<fs::path> submissions = submissions_in(command.grade.folder);
  require_free_names(submissions);
  ExecOptions exec = command.exec;
  exec.is_quiet = true;
  const Exercise exercise(exec, command.server);
  make_report_folder(command.grade.report);
  const auto run = [&](std::size_t index) {
    const fs::path& its = submissions[index];
    const std::string name = its.filename().string();
    return to_json(
        exercise.run({name, command_for(its, exec.command), its, command.grade.report + "/" + name,
                      "", 0, why_refused(its), index}));
  };
  std::size_t count = 0;
  const auto done = [&](std::size_t index) {
    print_error(std::to_string(++count) + " of " + std::to_string(submissions.size()) + ": " +
                printable_line(submissions[index].filename().string()) + "\n");
  };
  const std::size_t jobs = command.grade.jobs > 0 ? command.grade.jobs : usual_jobs();
  const auto texts = in_processes(submissions.size(), jobs, exercise.run_limit(), run, done);
  std::vector<RunReport> reports;
  bool has_all = true;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string name = submissions[i].filename().string();
    reports.push_back(report_of(texts[i], name));
    reports.back().program = name;  // its bytes, which lead to its files
    has_all = has_all && texts[i];
  }
  const std::string folder = command.grade.report + "/";
  write_file(folder + kPage, to_html(reports));
  write_file(folder + kTable, to_csv(reports));
  write_file(folder + kJunit, to_junit(reports));
  print_table(reports);
  return has_all ? ExitCode::kGood : ExitCode::kInternal;
}

}  // namespace xr3
