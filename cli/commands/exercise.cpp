#include "cli/exec/exercise.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/exec/expectation.hpp"
#include "cli/exec/hide.hpp"
#include "cli/exec/language.hpp"
#include "cli/exec/pool.hpp"
#include "cli/exec/sandbox.hpp"
#include "protocol/text/printable.hpp"
#include "server/files/data_files.hpp"
#include "server/log.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

/// A program, its start command, and the verdict that it must get.
struct Trial {
  std::string title;
  std::vector<std::string> command;
  Expectation expectation;
  std::size_t run = 1;  ///< from 1; each has the next seed
};

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& each : fs::directory_iterator(folder, none))
    if (each.is_regular_file() && !each.path().filename().string().starts_with('.'))
      files.push_back(each.path());
  std::ranges::sort(files);
  return files;
}

/// Makes the trials of a folder.
class Trials {
 public:
  Trials(const ExerciseFolder& folder, const RunFolder& scratch, std::size_t seeds)
      : folder_(folder), scratch_(scratch), seeds_(seeds) {
    for (const fs::path& each : files_in(folder.path()))
      if (each.stem() == "solution") add_solution(each);
    if (all_.empty())
      throw FileError(folder.path().string() +
                      ": there is no solution, as solution.py or solution.c");
    all_.push_back({"a program that does nothing", {"true"}, Expectation::no_points()});
    for (const fs::path& each : files_in(folder.path() / "starter"))
      all_.push_back({title(each), command(each), Expectation::no_points()});
    for (const fs::path& each : files_in(folder.path() / "wrong"))
      all_.push_back({title(each), command(each), stated_expectation(each)});
  }

  const std::vector<Trial>& all() const { return all_; }

 private:
  void add_solution(const fs::path& program) {
    for (std::size_t run = 1; run <= seeds_; ++run)
      all_.push_back({title(program) + (seeds_ > 1 ? ", run " + std::to_string(run) : ""),
                      command(program), Expectation::all_goals(), run});
  }

  std::string title(const fs::path& program) const {
    return printable_line(program.lexically_relative(folder_.path()).string());
  }

  /// The command of a program, with a file of its own for a compiler's output.
  std::vector<std::string> command(const fs::path& program) {
    return start_command(fs::absolute(program), scratch_.file(std::to_string(++programs_).c_str()),
                         exercises_folder());
  }

  const ExerciseFolder& folder_;
  const RunFolder& scratch_;
  std::size_t seeds_;
  std::size_t programs_ = 0;
  std::vector<Trial> all_;
};

/// Programs in Python find the package that comes with xr3, unless the user names another one.
void provide_package() {
  if (const std::string package = python_package(); !package.empty())
    ::setenv("PYTHONPATH", fs::path(package).parent_path().c_str(), 0);
}

std::string indented(const std::string& lines) {
  std::string text;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size() - 1);
    text += "    " + lines.substr(at, end + 1 - at);
    at = end + 1;
  }
  return text;
}

/// Prints the outcome of a trial; of a wrong program also its report, for the teacher.
void print(const Trial& trial, const RunReport& report, const std::string& trouble) {
  std::string text = (trouble.empty() ? "✓ " : "✗ ") + trial.title;
  if (!trouble.empty()) text += ": " + trouble;
  text += "\n";
  if (!trouble.empty() || trial.expectation.is_stated()) text += indented(to_text(report));
  print_text(text);
}

}  // namespace

ExitCode run_command(const ExerciseOptions& options) {
  hide_from_programs();
  ignore_signals_of_writing();
  start_log("off", "");
  provide_package();
  const ExerciseFolder folder(options.exercise);
  const RunFolder scratch(std::nullopt);
  ExecCommand command;
  command.exec.exercise = folder.path();
  command.exec.is_quiet = true;
  command.server.clock = {ClockMode::kBytes, Rate{}, {}};
  const Exercise exercise(command.exec, command.server);
  const Trials trials(folder, scratch, exercise.is_varied() ? options.seeds : 1);
  const std::vector<Trial>& all = trials.all();
  const auto texts = in_processes(
      all.size(), options.jobs > 0 ? options.jobs : usual_jobs(), exercise.run_limit(),
      [&](std::size_t i) {
        return to_json(exercise.run({all[i].title, all[i].command, "", "", "", all[i].run, "", i}));
      },
      [](std::size_t) {});
  bool is_proven = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const RunReport report = report_of(texts[i], all[i].title);
    const std::string trouble = all[i].expectation.trouble_of(report);
    is_proven = is_proven && trouble.empty();
    print(all[i], report, trouble);
  }
  return is_proven ? ExitCode::kGood : ExitCode::kBadInput;
}

}  // namespace xr3
