// xr3: parses the command line, runs the command, and turns every failure into a message and an
// exit code.
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <csignal>
#include <exception>
#include <iostream>

#include "protocol/json/finding.hpp"
#include "server/app.hpp"
#include "server/commands/check.hpp"
#include "server/commands/convert.hpp"
#include "server/commands/draw.hpp"
#include "server/commands/healthcheck.hpp"
#include "server/commands/kin.hpp"
#include "server/commands/watch.hpp"
#include "server/commands/workcell.hpp"
#include "server/files/data_files.hpp"
#include "server/log.hpp"
#include "server/monitor_port/token.hpp"
#include "server/options/options.hpp"
#include "server/options/pose_argument.hpp"

namespace xr3 {
namespace {

// Each line needs a descriptor: raises the limit as far as the system allows.
void raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

void warn_of_open_token(const TokenSource& source) {
  const auto* file = std::get_if<TokenFile>(&source);
  if (file != nullptr && others_may_read(file->path)) {
    spdlog::warn("{}: everybody on this machine may read the token; chmod 600 mends that",
                 file->path);
  }
}

ExitCode serve(const ServeOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);
  raise_descriptor_limit();
  start_log(options.log_level);
  warn_of_open_token(options.token);
  const std::string token = with_option_source(options.option_sources, "--token-file",
                                               [&] { return read_token(options.token); });
  return App(options, load_model(options), token).run();
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
  ExitCode operator()(const HealthOptions& options) const { return check_health(options); }
  ExitCode operator()(const Leave& leave) const {
    std::cout << leave.to_stdout;
    std::cerr << leave.to_stderr;
    return leave.code;
  }
};

ExitCode run(int argc, const char* const* argv) {
  try {
    return std::visit(Command{}, parse_options(argc, argv));
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

}  // namespace
}  // namespace xr3

int main(int argc, char** argv) { return xr3::as_int(xr3::run(argc, argv)); }
