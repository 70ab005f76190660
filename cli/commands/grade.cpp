#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
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
constexpr const char* kMoodle = "moodle.csv";  // only if there are submissions of Moodle

/// The files of a submission when it was run: see files_of(). In its folder of the report.
constexpr const char* kFilesFile = "files.txt";

constexpr std::array kReportFiles{kPage, kTable, kJunit};

bool is_report(const fs::path& path) {
  return std::ranges::all_of(kReportFiles, [&](const char* file) {
    std::error_code no_folder;
    return fs::exists(path / file, no_folder);
  });
}

bool is_submission(const fs::path& path) { return !is_by_the_way(path) && !is_report(path); }

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
    for (const char* file : {kPage, kTable, kJunit, kMoodle})
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

/// The result of an earlier run in its folder. Throws FileError if there is none.
RunReport result_in(const std::string& folder, const std::string& submission) {
  const std::string path = folder + "/" + kResultFile;
  try {
    return parse_report(read_file(path).text);
  } catch (const std::exception&) {
    throw FileError(path +
                    ": there is no result of this version of xr3 and this --repeat; remove " +
                    "the folder " + submission + ", and its submission is run again");
  }
}

/// The files of the submission whose result is in this folder; empty if they were not noted.
std::string files_in(const std::string& folder) try {
  return read_file(folder + "/" + kFilesFile).text;
} catch (const FileError&) {
  return "";
}

RunReport not_run_report() {
  RunReport report;
  report.outcome = RunOutcome::kNotRun;
  report.why = "not run: grading was stopped before";
  return report;
}

void print_table(const std::vector<Submission>& submissions) {
  const auto title = [](const Submission& each) { return printable_line(each.name()); };
  std::size_t width = 0;
  for (const Submission& each : submissions) width = std::max(width, title(each).size());
  TextStream table;
  for (const Submission& each : submissions) {
    const RunReport& run = each.counted();
    table << std::left << std::setw(static_cast<int>(width)) << title(each) << "  "
          << points_of(run.goals) << "/" << max_points_of(run.goals) << "  " << run.why << "\n";
  }
  print_text(table.str());
}

class Grading {
 public:
  explicit Grading(const GradeCommand& command)
      : options_(command.grade),
        exec_(command.exec),
        submissions_(submissions_in(options_.folder)),
        exercise_(quiet(command.exec), command.server),
        runs_(static_cast<std::size_t>(command.exec.repeat)),
        reports_(submissions_.size()) {
    require_free_names(submissions_);
    make_report_folder(options_.report, options_.has_only_missing);
    for (std::size_t i = 0; i < submissions_.size(); ++i) {
      files_.push_back(files_of(submissions_[i]));
      if (options_.has_only_missing) reports_[i] = results_of(i);
      if (reports_[i].empty()) missing_.push_back(i);
    }
  }

  ExitCode result() {
    run_missing();
    ClassReport report{exercise_.title(), {}};
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      // The bytes of the name, which lead to the submission's files.
      for (RunReport& each : reports_[i]) each.program = name_of(i);
      report.submissions.push_back({std::move(reports_[i])});
    }
    mark_twins(report.submissions);
    write(report);
    print_table(report.submissions);
    return has_all_ ? ExitCode::kGood : ExitCode::kInternal;
  }

 private:
  static ExecOptions quiet(ExecOptions exec) {
    exec.is_quiet = true;
    return exec;
  }

  std::string file(const std::string& name) const { return options_.report + "/" + name; }
  std::string name_of(std::size_t index) const { return submissions_[index].filename().string(); }
  /// The folder of a submission until all its runs are complete. No submission has such a name.
  std::string draft_of(std::size_t index) const { return file("." + name_of(index)); }
  /// The number of a run among several of a submission, from an index; 0 if there is one.
  std::size_t number_of(std::size_t run) const { return runs_ > 1 ? run + 1 : 0; }
  /// The folder of a run in that of its submission.
  std::string run_folder(const std::string& folder, std::size_t run) const {
    return runs_ > 1 ? folder + "/" + folder_of_run(number_of(run)) : folder;
  }

  /// The results of earlier runs of a submission; empty if it has no folder, or has changed.
  std::vector<RunReport> results_of(std::size_t index) const {
    std::error_code error;
    const std::string folder = file(name_of(index));
    std::vector<RunReport> results;
    if (!fs::exists(folder, error)) return results;
    for (std::size_t run = 0; run < runs_; ++run)
      results.push_back(result_in(run_folder(folder, run), folder));
    if (files_in(folder) != files_[index]) results.clear();
    return results;
  }

  /// Runs the submissions without a result, each run in a process of its own. SIGINT and SIGTERM
  /// end the runs in progress; the report has the others.
  void run_missing() {
    StopSignals stop;
    const std::size_t jobs = options_.jobs > 0 ? options_.jobs : usual_jobs();
    // A draft remains if a judge was killed.
    for (const std::size_t each : missing_) fs::remove_all(draft_of(each));
    std::vector<std::size_t> left(missing_.size(), runs_);
    const auto note = [&](std::size_t task) {
      if (--left[task / runs_] == 0) take(missing_[task / runs_], std::ranges::count(left, 0U));
    };
    const auto texts = in_processes(
        missing_.size() * runs_, jobs, exercise_.run_limit(),
        [this](std::size_t task) { return to_json(run(missing_[task / runs_], task % runs_)); },
        note, &stop);
    for (std::size_t i = 0; i < missing_.size(); ++i) {
      const bool is_run = left[i] == 0;
      for (std::size_t run = 0; run < runs_; ++run)
        add(missing_[i], run, texts[i * runs_ + run], is_run);
      if (!is_run) fs::remove_all(draft_of(missing_[i]));
    }
  }

  /// Adds the report of a run; of a submission whose runs were not completed only that.
  void add(std::size_t index, std::size_t run, const std::optional<std::string>& text,
           bool is_run) {
    reports_[index].push_back(is_run ? report_of(text, name_of(index), number_of(run))
                                     : not_run_report());
    has_all_ = has_all_ && is_run && text;
  }

  RunReport run(std::size_t index, std::size_t run) const {
    const fs::path& its = submissions_[index];
    std::string refused = why_refused(its);
    std::optional<fs::path> main = its;
    if (refused.empty()) main = main_of(its, options_.main);
    if (!main) refused = no_main(name_of(index));
    return exercise_.run({name_of(index), command_for(main.value_or(its), exec_.command), its,
                          run_folder(draft_of(index), run), "", number_of(run), refused,
                          index * runs_ + run});
  }

  std::string no_main(const std::string& name) const {
    const std::string extension = fs::path(options_.main).extension().string();
    return name + " has no file " + options_.main + ", and not exactly one other " +
           (extension.empty() ? "file without an extension" : extension + " file");
  }

  /// Gives a complete folder its name, in place of that of an earlier version of the submission,
  /// and says how many there are.
  void take(std::size_t index, std::ptrdiff_t count) const {
    if (is_complete(index)) replace(index);
    print_error(std::to_string(count) + " of " + std::to_string(missing_.size()) + ": " +
                printable_line(name_of(index)) + "\n");
  }

  // An error leaves a folder that does not count as a result the next time.
  void replace(std::size_t index) const {
    std::error_code failed;
    std::ofstream(draft_of(index) + "/" + kFilesFile, std::ios::binary) << files_[index];
    fs::remove_all(file(name_of(index)), failed);
    fs::rename(draft_of(index), file(name_of(index)), failed);
  }

  bool is_complete(std::size_t index) const {
    std::error_code failed;
    for (std::size_t run = 0; run < runs_; ++run)
      if (!fs::exists(run_folder(draft_of(index), run) + "/" + kResultFile, failed)) return false;
    return true;
  }

  void write(const ClassReport& report) const {
    std::vector<RunReport> counted;
    for (const Submission& each : report.submissions) counted.push_back(each.counted());
    write_file(file(kPage), to_html(report));
    write_file(file(kTable), to_csv(report));
    write_file(file(kJunit), to_junit(counted));
    const std::string moodle = to_moodle(report);
    if (!moodle.empty()) write_file(file(kMoodle), moodle);
  }

  const GradeOptions& options_;
  const ExecOptions& exec_;
  std::vector<fs::path> submissions_;
  std::vector<std::string> files_;  ///< files of each submission before it was run
  Exercise exercise_;
  std::size_t runs_;                             ///< number of each submission
  std::vector<std::vector<RunReport>> reports_;  ///< reports of the runs of each submission
  std::vector<std::size_t> missing_;             ///< indices of the submissions that are run
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
