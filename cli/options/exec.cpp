#include "cli/options/exec.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "cli/options/shared_options.hpp"

namespace xr3 {
namespace {

constexpr double kMaxSimSeconds = 1e6;
constexpr double kMaxSeconds = 86'400;
constexpr int kMaxRepeat = 100'000;
constexpr std::int64_t kMaxBytes = std::int64_t{1} << 53;
constexpr int kMaxProcesses = 100'000;

MonitorAccess monitor_named(const std::string& name) {
  return name == "read" ? MonitorAccess::kRead : MonitorAccess::kControl;
}

void add_limits(CLI::App& command, RunLimits& limits) {
  command
      .add_option_function<double>(
          "--max-sim-seconds",
          [&limits](double seconds) { limits.sim_ticks = std::llround(seconds * kTickHz); },
          "maximum simulated time of a run in seconds (default: 600)")
      ->type_name("SECONDS")
      ->check(number_between(0, kMaxSimSeconds));
  add_value(command, "--max-seconds", limits.wall_s, "SECONDS", "maximum time of a run in seconds")
      ->check(number_between(0, kMaxSeconds))
      ->capture_default_str();
  add_value(command, "--max-bytes", limits.bytes, "N",
            "maximum number of bytes that a program sends")
      ->check(whole_number_between(1, kMaxBytes));
  add_value(command, "--memory", limits.memory_mib, "MIB",
            "MiB of memory that all its processes may have together")
      ->check(whole_number_between(1, kMaxMemoryMib))
      ->capture_default_str();
  add_value(command, "--processes", limits.processes, "N", "number of processes that it may have")
      ->check(whole_number_between(1, kMaxProcesses))
      ->capture_default_str();
}

/// Adds --exercise, which excludes the options that an exercise sets.
void add_exercise(CLI::App& command, ExecOptions& options) {
  CLI::Option* exercise =
      add_value(command, "--exercise", options.exercise, "NAME|FOLDER|ZIP",
                "exercise with robot, workcell, faults, clock and goals: a name, or its files");
  for (const char* each : {"--robot", "--workcell", "--fault", "--clock", "--goals"})
    exercise->excludes(each);
}

/// Adds the options of both exec and grade: the robot, the goals, limits.
void add_run(CLI::App& command, ExecOptions& options, ServeOptions& server) {
  server.clock = {ClockMode::kBytes, Rate{}, {}};
  server.log_level = "off";
  add_machine(command, server);
  add_time(command, server,
           "bytes (default): time follows the program; real, FACTOR times as fast; manual");
  add_line_speed(command, server);
  add_value(command, "--goals", options.goals, "FILE",
            "file with the goals by which a run is judged");
  add_exercise(command, options);
  add_limits(command, options.limits);
  add_parsed(command, "--vary", options.vary, parse_variation, "SEED[:MM[,DEG]]",
             "move the blocks at random by at most 40 mm (or MM) and 180 degrees (or DEG)");
  command
      .add_option_function<std::string>(
          "--monitor",
          [&options](const std::string& access) { options.monitor = monitor_named(access); },
          "the program gets a monitor port, to read, or to control (which the report says)")
      ->type_name("read|control")
      ->check(CLI::IsMember({"read", "control"}).description(""));
}

void add_repeat(CLI::App& command, ExecOptions& options, const std::string& help) {
  add_value(command, "--repeat", options.repeat, "N", help)
      ->check(whole_number_between(1, kMaxRepeat))
      ->capture_default_str();
}

void add_user(CLI::App& command, ExecOptions& options) {
  add_value(
      command, "--run-as", options.run_as, "USER",
      "for root: the user of the program (default: in the sandbox one without a name for each "
      "job, from 61184)");
}

void add_readable(CLI::App& command, ExecOptions& options, const std::string& when) {
  add_value(command, "--read", options.readable, "PATH",
            when + "a further file or folder that it may read")
      ->allow_extra_args(false);
}

/// Adds the options of the sandbox. `exec` runs a trusted program, `grade` untrusted ones.
void add_sandbox_of_exec(CLI::App& command, ExecOptions& options) {
  options.without_sandbox = "leave out --sandbox, which runs the program with your rights";
  CLI::Option* sandbox = command.add_flag(
      "--sandbox", options.is_sandboxed,
      "run it under bubblewrap: no network but the robot, no files but the system's and its own");
  command.get_option("--monitor")->excludes(sandbox);
  add_readable(command, options, "with --sandbox: ");
  command.get_option("--read")->needs(sandbox);
}

void add_sandbox_of_grade(CLI::App& command, ExecOptions& options) {
  options.is_sandboxed = true;
  options.without_sandbox = "add --no-sandbox, which runs the submissions with your rights";
  CLI::Option* none = command.add_flag_callback(
      "--no-sandbox", [&options] { options.is_sandboxed = false; },
      "run them with your rights, not under bubblewrap: no protection from what they do");
  command.get_option("--monitor")->needs(none);
  add_readable(command, options, "in the sandbox: ");
  command.get_option("--read")->excludes(none);
}

}  // namespace

void add_exec(CLI::App& app, ExecOptions& options, ServeOptions& server) {
  CLI::App& exec = *app.add_subcommand(
      "exec", "run a robot program against a fresh robot, and judge it by its goals");
  add_run(exec, options, server);
  add_repeat(exec, options,
             "number of runs; with --vary each has the next seed, without it all must be equal");
  add_value(exec, "--record", server.record, "FILE", "record the run in this new file");
  add_value(exec, "--csv", options.csv, "OUT.csv",
            "write joints, counts and tip each 100 ms as a table");
  add_value(exec, "--junit", options.junit, "OUT.xml", "write the results for test reporters");
  add_value(exec, "--json", options.json, "OUT.json",
            "write the results as JSON, one object a line");
  add_value(exec, "--markdown", options.markdown, "OUT.md",
            "write the results as a table in Markdown");
  add_value(exec, "--github", options.github, "OUT.txt",
            "write the missed goals as annotations for GitHub Actions");
  add_value(exec, "--out", options.out, "FOLDER",
            "new folder for output, recording, picture of the end and result of each run");
  exec.add_flag("--stdin", options.has_input, "the program reads standard input");
  exec.add_flag("--quiet", options.is_quiet, "do not show what the program prints");
  add_sandbox_of_exec(exec, options);
  add_user(exec, options);
  add_log(exec, server);
  add_value(exec, "command", options.command, "PROGRAM [ARG]",
            "the program and its arguments, after --")
      ->required();
}

void add_grade(CLI::App& app, GradeOptions& options, ExecOptions& exec, ServeOptions& server) {
  CLI::App& grade = *app.add_subcommand(
      "grade", "run every submission in a folder as xr3 exec does, and write a report");
  add_value(grade, "folder", options.folder, "FOLDER",
            "the submissions: each file or folder in it is one")
      ->required();
  add_run(grade, exec, server);
  grade.callback([&exec] {
    if (exec.goals.empty() && exec.exercise.empty())
      throw CLI::ValidationError("xr3 grade needs --goals or --exercise");
  });
  add_repeat(
      grade, exec,
      "number of runs of each, of which the worst counts; with --vary each has the next seed");
  add_value(grade, "--main", options.main, "FILE",
            "in a submission that is a folder {} is this file, or the only one with its extension");
  add_value(grade, "--report", options.report, "FOLDER", "new folder for the report")->required();
  grade.add_flag("--only-missing", options.has_only_missing,
                 "continue a report: run the submissions that are new or have changed since");
  add_sandbox_of_grade(grade, exec);
  add_user(grade, exec);
  add_value(grade, "--jobs", options.jobs, "N", "number of submissions that run at a time")
      ->check(whole_number_between(1, kMaxJobs));
  add_value(grade, "command", exec.command, "PROGRAM [ARG]",
            "the program and its arguments, after --; {} is the submission")
      ->required();
}

}  // namespace xr3
