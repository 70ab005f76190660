// xr3: parses the command line, runs the command, and turns every failure into a message and an
// exit code.
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/json/finding.hpp"
#include "server/app.hpp"
#include "server/build_info.hpp"
#include "server/commands/check.hpp"
#include "server/commands/convert.hpp"
#include "server/commands/draw.hpp"
#include "server/commands/exec.hpp"
#include "server/commands/grade.hpp"
#include "server/commands/healthcheck.hpp"
#include "server/commands/kin.hpp"
#include "server/commands/manual.hpp"
#include "server/commands/replay.hpp"
#include "server/commands/watch.hpp"
#include "server/commands/workcell.hpp"
#include "server/files/data_files.hpp"
#include "server/files/load_model.hpp"
#include "server/log.hpp"
#include "server/monitor_port/token.hpp"
#include "server/options/options.hpp"
#include "server/options/pose_argument.hpp"
#include "server/term/term.hpp"

namespace xr3 {
namespace {

void warn_of_open_token(const TokenSource& source) {
  const auto* file = std::get_if<TokenFile>(&source);
  if (file != nullptr && others_may_read(file->path)) {
    spdlog::warn("{}: every user of this machine can read the token; set mode 600", file->path);
  }
}

/// The seeds of the cells; cells of the same files share a model.
std::vector<CellSeed> load_seeds(const ServeOptions& options) {
  std::vector<CellPlan> plans = plan_cells(options);
  if (plans.empty()) plans.push_back({"", options.robot, options.workcell, 0});
  std::map<std::pair<std::string, std::string>, CellSeed> loaded;
  std::vector<CellSeed> seeds;
  for (const CellPlan& plan : plans) {
    CellSeed& seed = loaded[{plan.robot, plan.workcell}];
    if (!seed.model) seed = load_seed(options, plan.robot, plan.workcell);
    seeds.push_back(seed);
  }
  return seeds;
}

/// A broken connection, or a file that reaches its limit, is an error of the call, not the end.
void ignore_signals_of_writing() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

ExitCode serve(const ServeOptions& options) {
  ignore_signals_of_writing();
  with_option_source(options.option_sources, "--log-file",
                     [&] { start_log(options.log_level, options.log_file); });
  warn_of_open_token(options.token);
  const std::string token = with_option_source(options.option_sources, "--token-file",
                                               [&] { return read_token(options.token); });
  App app(options, load_seeds(options), token);
  return app.run();
}

ExitCode replay(const ReplayCommand& command) {
  if (!command.replay.is_serving) return replay_file(command.replay);
  ignore_signals_of_writing();
  return replay_and_serve(command);
}

ExitCode fail(ExitCode code, const std::string& message) {
  std::cerr << "xr3: " << message << "\n";
  return code;
}

struct Command {
  ExitCode operator()(const ServeOptions& options) const { return serve(options); }
  ExitCode operator()(const CheckOptions& options) const { return check_files(options); }
  ExitCode operator()(const DrawOptions& options) const { return draw(options); }
  ExitCode operator()(const KinOptions& options) const { return show_kinematics(options); }
  ExitCode operator()(const ConvertOptions& options) const { return convert_file(options); }
  ExitCode operator()(const WorkcellOptions& options) const { return edit_workcell(options); }
  ExitCode operator()(const WatchOptions& options) const { return watch_cell(options); }
  ExitCode operator()(const TermOptions& options) const { return run_term(options); }
  ExitCode operator()(const HealthOptions& options) const { return check_health(options); }
  ExitCode operator()(const ReplayCommand& command) const { return replay(command); }
  ExitCode operator()(const ExecCommand& command) const {
    ignore_signals_of_writing();
    return exec_program(command);
  }
  ExitCode operator()(const GradeCommand& command) const {
    ignore_signals_of_writing();
    return grade_submissions(command);
  }
  ExitCode operator()(const ManualFiles& manual) const { return write_manual(manual); }
  ExitCode operator()(const Leave& leave) const {
    std::cout << leave.to_stdout;
    std::cerr << leave.to_stderr;
    return leave.code;
  }
};

ExitCode run(int argc, const char* const* argv) {
  try {
    return std::visit(Command{}, parse_options(argc, argv, kBuildInfo));
  } catch (const ListenError& error) {
    return fail(error.code(), error.what());
  } catch (const FileError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const TokenError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const ArgumentError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const DataError& error) {
    std::cerr << to_text(error.findings());
    return ExitCode::kBadInput;
  } catch (const std::exception& error) {
    return fail(ExitCode::kInternal, error.what());
  }
}

// If standard input, output or error is closed, a socket would get its number, and receive what is
// meant for people. /dev/null takes the place.
void open_standard_streams() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (::fcntl(file, F_GETFD) == 0) continue;
    if (::open("/dev/null", O_RDWR) != file) std::abort();  // opens the lowest free number
  }
}

// Output that was lost, as on a full disk, must not look like success.
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
