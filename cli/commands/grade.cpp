#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <optional>
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

/// The page of the report, beside the folders of the submissions.
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

void make_report_folder(const std::string& path, bool may_exist) {
  std::error_code error;
  if (!may_exist && fs::exists(path, error) && !fs::is_empty(path, error))
    throw FileError(path +
                    ": there is something in this folder; name a new one for the report, or add "
                    "--only-missing to continue this one");
  fs::create_directories(path, error);
  if (error) throw FileError(path + ": cannot be made: " + error.message());
}

/// The result of an earlier run in its folder; nullopt if there is no such folder.
std::optional<RunReport> result_in(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return std::nullopt;
  const std::string path = folder + "/" + kResultFile;
  try {
    return parse_report(read_file(path).text);
  } catch (const std::exception&) {
    throw FileError(path + ": there is no result of this version of xr3; remove the folder " +
                    folder + ", and its submission is run again");
  }
}

RunReport not_run_report() {
  RunReport report;
  report.outcome = RunOutcome::kNotRun;
  report.why = "not run: grading was stopped before";
  return report;
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

class Grading {
 public:
  explicit Grading(const GradeCommand& command)
      : options_(command.grade),
        exec_(command.exec),
        submissions_(submissions_in(options_.folder)),
        exercise_(quiet(command.exec), command.server),
        reports_(submissions_.size()) {
    require_free_names(submissions_);
    make_report_folder(options_.report, options_.has_only_missing);
    for (std::size_t i = 0; i < submissions_.size(); ++i) {
      if (options_.has_only_missing) reports_[i] = result_in(file(name_of(i)));
      if (!reports_[i]) missing_.push_back(i);
    }
  }

  ExitCode result() {
    run_missing();
    std::vector<RunReport> reports;
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      reports.push_back(std::move(*reports_[i]));
      // The bytes of the name, which lead to the submission's files.
      reports.back().program = name_of(i);
    }
    write_file(file(kPage), to_html(reports));
    write_file(file(kTable), to_csv(reports));
    write_file(file(kJunit), to_junit(reports));
    print_table(reports);
    return has_all_ ? ExitCode::kGood : ExitCode::kInternal;
  }

 private:
  static ExecOptions quiet(ExecOptions exec) {
    exec.is_quiet = true;
    return exec;
  }

  std::string file(const std::string& name) const { return options_.report + "/" + name; }
  std::string name_of(std::size_t index) const { return submissions_[index].filename().string(); }
  /// The folder of a run until it is complete. No submission has such a name.
  std::string draft_of(std::size_t index) const { return file("." + name_of(index)); }

  /// Runs the submissions without a result. SIGINT and SIGTERM end the runs in progress; the report
  /// has the others.
  void run_missing() {
    StopSignals stop;
    const std::size_t jobs = options_.jobs > 0 ? options_.jobs : usual_jobs();
    std::vector<bool> is_run(missing_.size());
    const auto note = [&](std::size_t i) {
      is_run[i] = true;
      take(missing_[i]);
      print_error(std::to_string(std::ranges::count(is_run, true)) + " of " +
                  std::to_string(missing_.size()) + ": " + printable_line(name_of(missing_[i])) +
                  "\n");
    };
    const auto texts = in_processes(
        missing_.size(), jobs, exercise_.run_limit(),
        [this](std::size_t i) { return to_json(run(missing_[i])); }, note, &stop);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      reports_[missing_[i]] =
          is_run[i] ? report_of(texts[i], name_of(missing_[i])) : not_run_report();
      has_all_ = has_all_ && texts[i];
      if (!is_run[i]) fs::remove_all(draft_of(missing_[i]));
    }
  }

  RunReport run(std::size_t index) const {
    const fs::path& its = submissions_[index];
    fs::remove_all(draft_of(index));  // a draft remains if a judge was killed
    return exercise_.run({name_of(index), command_for(its, exec_.command), its, draft_of(index), "",
                          0, why_refused(its), index});
  }

  /// Gives a complete folder its name.
  void take(std::size_t index) const {
    std::error_code failed;
    if (fs::exists(draft_of(index) + "/" + kResultFile, failed))
      fs::rename(draft_of(index), file(name_of(index)), failed);
  }

  const GradeOptions& options_;
  const ExecOptions& exec_;
  std::vector<fs::path> submissions_;
  Exercise exercise_;
  std::vector<std::optional<RunReport>> reports_;  ///< one for each submission
  std::vector<std::size_t> missing_;               ///< indices of the submissions that are run
  bool has_all_ = true;
};

}  // namespace

ExitCode run_command(const GradeCommand& command) {
  hide_from_programs();
  ignore_signals_of_writing();
  start_log(command.server.log_level, "");
  require_place(command.exec.command);
  return Grading(command).result();
}

}  // namespace xr3
