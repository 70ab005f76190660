#include <unistd.h>

#include <memory>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/term/console.hpp"
#include "cli/term/device_peer.hpp"
#include "cli/term/pipe.hpp"
#include "cli/term/session.hpp"
#include "cli/term/tcp_peer.hpp"
#include "server/files/load_model.hpp"

namespace xr3 {
namespace {

/// An open peer, and a warning about it for the user.
struct OpenPeer {
  std::unique_ptr<TermPeer> peer;
  std::string greeting;
  std::string warning;  ///< may be empty
};

ReplyContext robot_of(const TermOptions& options) {
  ReplyContext unknown;
  unknown.profile = options.profile;
  if (options.robot.empty() && options.workcell.empty()) return unknown;
  const std::string robot = options.robot.empty() ? kUsualRobot : options.robot;
  return context_of(*load_model({robot, options.workcell, options.profile}));
}

std::string warning_of(const TermOptions& options, const TelnetClient& telnet) {
  if (!telnet.has_com_port()) {
    return options.peer + " has refused COM-PORT (RFC 2217): it has no settings and no break";
  }
  const std::string wanted = text_of(options.settings);
  const std::string got = text_of(telnet.settings());
  return got == wanted ? "" : options.peer + " has set " + got + " instead of " + wanted;
}

OpenPeer open_peer(asio::io_context& context, const TermOptions& options) {
  const std::string settings = text_of(options.settings);
  if (options.is_path) {
    return {std::make_unique<DevicePeer>(context, options.peer, options.settings),
            options.peer + " is open, " + settings, ""};
  }
  auto peer = connect_peer(context, options);
  const std::string connected = "connected to " + options.peer;
  if (!peer->telnet()) return {std::move(peer), connected, ""};
  std::string warning = warning_of(options, *peer->telnet());
  return {std::move(peer), connected + ", RFC 2217, " + settings, std::move(warning)};
}

TermSession::Limits limits_of(const TermOptions& options, bool is_script) {
  const auto timeout = std::chrono::duration<double>(options.timeout_s);
  return {std::chrono::duration_cast<std::chrono::milliseconds>(timeout), is_script};
}

ExitCode run_console(asio::io_context& context, const TermOptions& options, OpenPeer& open,
                     const ReplyContext& robot) {
  TermConsole console(context, options);
  TermSession session(context, *open.peer, options.peer, robot, limits_of(options, false), console);
  session.start();
  console.start(session, open.greeting + "; ~. quits, ~? is help");
  if (!open.warning.empty()) console.say(open.warning);
  context.run();
  return session.exit_code();
}

ExitCode run_pipe(asio::io_context& context, const TermOptions& options, OpenPeer& open,
                  const ReplyContext& robot) {
  TermPipe pipe(context, options.view);
  TermSession session(context, *open.peer, options.peer, robot, limits_of(options, true), pipe);
  if (!open.warning.empty()) pipe.say(open.warning);
  session.start();
  pipe.start(session);
  context.run();
  return session.exit_code();
}

}  // namespace

ExitCode run_command(const TermOptions& options) {
  ignore_signals_of_writing();
  const ReplyContext robot = robot_of(options);
  const bool is_interactive = ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0;
  asio::io_context context;
  OpenPeer open = open_peer(context, options);
  return is_interactive ? run_console(context, options, open, robot)
                        : run_pipe(context, options, open, robot);
}

}  // namespace xr3
