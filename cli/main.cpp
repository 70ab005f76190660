// xr3: parses the command line, runs the command, and turns every failure into a message and an
// exit code.
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "cli/build_info.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/exec/exercise_folder.hpp"
#include "cli/options/options.hpp"
#include "protocol/json/finding.hpp"
#include "server/app.hpp"
#include "server/log.hpp"
#include "server/options/token.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

/// The seeds of the cells; cells of the same files share a model. The goals are for those with the
/// robot and workcell of the options.
std::vector<CellSeed> load_seeds(const ServeOptions& options) {
  std::vector<CellPlan> plans = plan_cells(options);
  if (options.is_cell_per_connection) plans.push_back({"", options.robot, options.workcell, 0});
  std::map<std::pair<std::string, std::string>, CellSeed> loaded;
  std::vector<CellSeed> seeds;
  for (const CellPlan& plan : plans) {
    CellSeed& seed = loaded[{plan.robot, plan.workcell}];
    if (!seed.model) seed = load_seed(options, plan.robot, plan.workcell);
    const bool is_usual = plan.robot == options.robot && plan.workcell == options.workcell;
    if (is_usual && !seed.exercise) seed.exercise = load_live_exercise(options, seed);
    seeds.push_back(seed);
  }
  return seeds;
}

ExitCode run_command(ServeOptions options) {
  ignore_signals_of_writing();
  std::optional<ExerciseFolder> exercise;  // an unpacked archive exists as long as it does
  if (!options.exercise.empty()) exercise.emplace(options.exercise).set_for_lesson(options);
  with_option_source(options.option_sources, "--log-file",
                     [&] { start_log(options.log_level, options.log_file); });
  const std::string token = with_option_source(options.option_sources, "--token-file",
                                               [&] { return read_token(options.token); });
  App app(options, load_seeds(options), token);
  return app.run();
}

ExitCode run_command(const Leave& leave) {
  print_text(leave.to_stdout);
  print_error(leave.to_stderr);
  return leave.code;
}

ExitCode run(int argc, const char* const* argv) {
  try {
    return std::visit([](const auto& command) { return run_command(command); },
                      parse_options(argc, argv, kBuildInfo));
  } catch (const ExitError& error) {
    return fail(error.code(), error.what());
  } catch (const DataError& error) {
    print_error(to_text(error.findings()));
    return ExitCode::kBadInput;
  } catch (const std::exception& error) {
    return fail(ExitCode::kInternal, error.what());
  }
}

// Opens /dev/null for a closed standard input, output or error. A socket would otherwise get its
// number, and receive text that is printed for the user.
void open_standard_streams() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (::fcntl(file, F_GETFD) == 0) continue;
    if (::open("/dev/null", O_RDWR) != file) std::abort();  // opens the lowest free number
  }
}

// The exit code of a failure if output was lost, as on a full disk; else `code`.
ExitCode flushed(ExitCode code) {
  std::cout.flush();
  if (std::cout || code != ExitCode::kGood) return code;
  return fail(ExitCode::kInternal, "standard output cannot be written");
}

}  // namespace
}  // namespace xr3

int main(int argc, char** argv) {
  xr3::open_standard_streams();
  return xr3::as_int(xr3::flushed(xr3::run(argc, argv)));
}
