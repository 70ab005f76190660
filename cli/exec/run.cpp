#include "cli/exec/run.hpp"

#include <unistd.h>

#include <boost/asio/signal_set.hpp>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cell/judge/passive.hpp"
#include "cell/judge/sim_limit.hpp"
#include "cli/exec/descendants.hpp"
#include "cli/exec/kept_output.hpp"
#include "cli/exec/run_folder.hpp"
#include "cli/exec/sandbox.hpp"
#include "cli/exec/script.hpp"
#include "cli/exec/throw_errno.hpp"
#include "cli/exec/transcript_text.hpp"
#include "cli/exec/usage.hpp"
#include "protocol/goals/credit.hpp"
#include "protocol/goals/goal_text.hpp"
#include "protocol/text/table.hpp"
#include "server/files/data_files.hpp"
#include "server/net/wall_clock.hpp"
#include "server/recording/joint_table.hpp"
#include "tools/watch/top_view.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

constexpr auto kCheckEvery = 50ms;
constexpr WallNs kGrace = 2'000'000'000;      // between SIGTERM and SIGKILL
constexpr WallNs kReadLimit = 5'000'000'000;  // for what the program has sent before its end
constexpr double kNsPerSecond = 1e9;

/// Samples a cell for the table of --csv.
class TableSampler final : private CellObserver {
 public:
  TableSampler(Cell& cell, const std::string& path)
      : cell_(cell), table_(cell.model(), path), epoch_(cell.epoch()) {
    ticked(cell);
    cell.observe(*this, Cell::Ticks::kEach);
  }
  ~TableSampler() override { cell_.end_observation(*this); }

  JointTable& table() { return table_; }

 private:
  static constexpr Tick kEvery = 100;  // between two lines

  // A cell passes over ticks at rest, in which nothing changes.
  void ticked(const Cell& cell) override {
    if (std::exchange(epoch_, cell.epoch()) != cell.epoch()) next_ = 0;
    for (; next_ <= cell.state().tick && !table_.is_full(); next_ += kEvery)
      table_.add(cell, next_);
  }

  Cell& cell_;
  JointTable table_;
  Epoch epoch_;
  Tick next_ = 0;
};

/// The end of a program in the sandbox, from that of bubblewrap, which turns signal N into the exit
/// code 128 + N.
ProgramEnd end_in_sandbox(const ProgramEnd& end) {
  constexpr int kSignalled = 128;
  const int signal = end.code - kSignalled;
  return signal > 0 && signal <= SIGRTMAX ? ProgramEnd{0, signal} : end;
}

class Run {
 public:
  Run(const RunSettings& settings, const GoalList& goals)
      : settings_(settings),
        goals_(goals),
        folder_(settings.user),
        output_(settings.output_file, settings.exec.is_quiet),
        network_(settings.exec.is_sandboxed ? std::make_optional<PrivateNetwork>(settings.user)
                                            : std::nullopt),
        host_(settings.server, settings.seed, settings.exec.monitor, pty(),
              network_ ? network_->release_listener() : -1),
        observer_(host_.cell(), goals),
        sim_limit_(host_.cell(), observer_, settings.exec.limits.sim_ticks),
        table_(settings.exec.csv.empty()
                   ? std::optional<TableSampler>()
                   : std::optional<TableSampler>(std::in_place, host_.cell(), settings.exec.csv)),
        timer_(host_.io()),
        signals_(host_.io(), SIGINT, SIGTERM) {
    host_.cell().observe(transcript_);
    give_terminal();
  }

  RunResult result() {
    begin_ = wall_now();
    if (start()) {
      pass_signals_on();
      watch_limits();
      host_.on_input([this] { check_limits(); });
      host_.run([this] { return is_over_; });
      end_processes();
      read_output();
      read_lines();
    }
    check_reached();
    host_.on_input({});
    host_.come_to_rest(sim_limit_.left(kRestLimit));
    host_.finish_recording();
    return judged();
  }

 private:
  std::string pty() const { return folder_.file("serial"); }

  void give_terminal() {
    if (const auto& user = settings_.user;
        user && ::chown(pty().c_str(), user->user, user->group) != 0)
      throw_errno("the pseudo-terminal cannot be given to the user of the program");
  }

  /// Files for the sandbox: those that its command names, and others.
  std::vector<Binding> bindings() {
    std::vector<Binding> all;
    const auto add = [&](const std::string& name) {
      std::error_code error;
      const auto path = std::filesystem::absolute(name, error).lexically_normal();
      const auto followed = std::filesystem::canonical(path, error);
      if (!error && !name.empty()) all.push_back(folder_.readable(followed, path));
    };
    for (const std::string& each : settings_.exec.command) add(each);
    for (const std::string& each : settings_.exec.readable) add(each);
    if (const std::string package = python_package(); !package.empty())
      all.push_back(folder_.readable(package, std::string(kSandboxPython) + "/xr3"));
    return all;
  }

  ProgramSettings program() {
    ProgramSettings program;
    program.command = settings_.exec.command;
    if (network_) {
      program.command =
          sandboxed(settings_.exec.command, bindings(), std::filesystem::read_symlink(pty()));
      program.network = &*network_;
      program.is_stranger = true;
    }
    program.user = settings_.user;
    program.environment = {{"XR3_HOST", "127.0.0.1"},
                           {"XR3_PORT", std::to_string(host_.robot_port())},
                           {"XR3_PTY", network_ ? kSandboxPty : pty()},
                           {"PYTHONUNBUFFERED", "1"}};  // shows the output as it is printed
    if (network_) program.environment.emplace_back("PYTHONPATH", kSandboxPython);
    // The questions of a program let time pass: it need not wait between them.
    if (settings_.server.clock.mode == ClockMode::kBytes)
      program.environment.emplace_back("XR3_POLL_MS", "0");
    if (const auto port = host_.monitor_port())
      program.environment.emplace_back("XR3_MONITOR_PORT", std::to_string(*port));
    program.has_input = settings_.exec.has_input;
    program.max_tasks = kTasksOfProcess * settings_.exec.limits.processes;
    return program;
  }

  bool start() {
    if (!settings_.refused.empty()) return fail(settings_.refused);
    try {
      program_.emplace(host_.io(), program(),
                       [this](int stream, std::string_view text) { output_.add(stream, text); });
    } catch (const std::system_error& error) {
      const std::string trouble = interpreter_trouble(settings_.exec.command.front());
      return fail(settings_.exec.command.front() +
                  " cannot be started: " + (trouble.empty() ? error.code().message() : trouble));
    }
    program_->on_end([this](const ProgramEnd& end) { ended(end); });
    return true;
  }

  void ended(const ProgramEnd& end) {
    is_over_ = true;
    if (end.is_good() || report_.outcome == RunOutcome::kTimeUp) return;
    const std::string trouble = interpreter_trouble(settings_.exec.command.front());
    fail("the program ended with " + to_text(network_ ? end_in_sandbox(end) : end) +
         (trouble.empty() ? "" : ": ") + trouble);
  }

  bool fail(std::string why) {
    report_.outcome = RunOutcome::kFailed;
    report_.why = std::move(why);
    return false;
  }

  void pass_signals_on() {
    signals_.async_wait([this](ErrorCode cancelled, int signal) {
      if (cancelled) return;
      if (signal == SIGTERM) is_over_ = true;  // the end of the run passes it on
      if (signal != SIGTERM) program_->signal(signal);
      pass_signals_on();
    });
  }

  // --- Limits.

  void watch_limits() {
    run_after(timer_, kCheckEvery, [this] {
      if (is_over_) return;
      host_.cell().catch_up(wall_now());
      check_limits();
      watch_limits();
    });
  }

  void check_limits() {
    if (is_over_) return;
    const RunLimits& limits = settings_.exec.limits;
    if (sim_limit_.moment()) return stop(sim_limit_text());
    if (limits.wall_s > 0 && wall_s() > limits.wall_s)
      return stop("the program still ran after " + plain_number(limits.wall_s, 4) +
                  " seconds (--max-seconds)");
    if (limits.bytes > 0 && host_.cell().counters().bytes_in > limits.bytes)
      return stop("the program sent more than " + std::to_string(limits.bytes) +
                  " bytes (--max-bytes)");
    if (wall_now() < next_count_) return;
    next_count_ = wall_now() + kCountEvery;
    check_usage();
  }

  void check_usage() {
    const RunLimits& limits = settings_.exec.limits;
    const Usage usage = usage_of(its_processes(), folders_);
    if (limits.processes > 0 && usage.processes > limits.processes)
      return stop("the program had more than " + std::to_string(limits.processes) +
                  " processes (--processes)");
    if (limits.memory_mib > 0 && usage.memory_bytes > std::uint64_t{limits.memory_mib} << 20U)
      return stop("the program had more than " + std::to_string(limits.memory_mib) +
                  " MiB of memory (--memory)");
    if (usage.files > kMaxFiles)
      return stop("the program had more than " + std::to_string(kMaxFiles) + " files");
  }

  /// The processes of the program, without those that keep it: its keeper, or the two of
  /// bubblewrap.
  std::vector<::pid_t> its_processes() const {
    std::vector<::pid_t> all = descendants();
    const std::size_t kept = network_ ? 2 : program_->has_keeper() ? 1 : 0;
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(kept, all.size())));
    return all;
  }

  std::string sim_limit_text() const {
    return "the limit of " + seconds_text(settings_.exec.limits.sim_ticks) +
           " simulated seconds was reached (--max-sim-seconds)";
  }

  void stop(std::string why) {
    report_.outcome = RunOutcome::kTimeUp;
    report_.why = std::move(why);
    is_over_ = true;
  }

  double wall_s() const { return static_cast<double>(wall_now() - begin_) / kNsPerSecond; }

  // --- The end.

  /// Ends the program, if it still runs, and all that it has started.
  void end_processes() {
    is_over_ = false;
    program_->signal(SIGTERM);
    wait_until(wall_now() + kGrace,
               [this] { return program_->has_ended() && !program_->has_group(); });
    end_children(wall_now() + kKillLimit, program_->has_ended() ? 0 : program_->pid());
    wait_until(wall_now() + kGrace, [this] { return program_->has_ended(); });
  }

  /// Reads all output that was printed before the program's end.
  void read_output() {
    wait_until(wall_now() + kReadLimit, [this] { return !program_->has_output(); });
  }

  void read_lines() {
    host_.close_ports();
    wait_until(wall_now() + kReadLimit, [this] { return host_.are_lines_closed(); });
    host_.abort_lines();
  }

  /// Runs the event loop until the predicate holds or the deadline passes.
  void wait_until(WallNs deadline, const std::function<bool()>& is_so) {
    asio::steady_timer soon(host_.io());
    std::chrono::milliseconds pause{1};
    while (!is_so() && wall_now() < deadline) {
      bool is_due = false;
      soon.expires_after(pause);
      soon.async_wait([&is_due](ErrorCode) { is_due = true; });
      host_.run([&is_due] { return is_due; });
      reap_children(program_->has_ended() ? 0 : program_->pid());
      pause = std::min(2 * pause, std::chrono::milliseconds{kCheckEvery});
    }
  }

  /// Adds a hint if no client reached the robot: a program that uses another robot looks as if it
  /// did nothing.
  void check_reached() {
    const bool may_call = settings_.exec.monitor == MonitorAccess::kControl;
    if (!program_ || may_call || host_.cell().counters().lines_total > 0) return;
    report_.why += report_.why.empty() ? "" : "; ";
    report_.why += "nothing reached this run's robot: use XR3_HOST and XR3_PORT";
  }

  RunResult judged() {
    if (table_) table_->table().finish();
    if (sim_limit_.moment() && report_.outcome == RunOutcome::kFinished) stop(sim_limit_text());
    const Cell& cell = host_.cell();
    JudgedMoment end = sim_limit_.moment().value_or(moment_of(cell, observer_));
    report_.wall_s = wall_s();
    report_.ticks = end.state.tick;
    report_.bytes = end.facts.bytes;
    report_.errors = output_.errors();
    report_.has_control = settings_.exec.monitor == MonitorAccess::kControl;
    report_.transcript = std::move(end.transcript);
    report_.goals = judge(goals_, cell.model(), end.state, end.facts);
    const auto passive = passive_goals(goals_, settings_.seed.model, settings_.seed.faults);
    report_.not_counted = withhold(report_.goals, goals_, passive, report_.outcome, end.facts);
    report_.top_view = view_of(cell.model(), end.state);
    return {std::move(report_), transcript_.text(), cell.model_ptr(), std::move(end.state)};
  }

  static std::string view_of(const Model& model, const State& state) {
    Workcell now = model.workcell();
    now.blocks = state.blocks;
    return top_view(now, {});
  }

  static constexpr WallNs kCountEvery = 100'000'000;
  static constexpr std::uint64_t kMaxFiles = 10'000;
  /// Threads count, too: enough for them, and a bound for a program that starts processes without
  /// end, between two checks.
  static constexpr std::size_t kTasksOfProcess = 16;

  const RunSettings& settings_;
  const GoalList& goals_;
  const std::vector<std::string> folders_{"/tmp", "/dev/shm", std::filesystem::current_path()};
  RunFolder folder_;
  KeptOutput output_;
  std::optional<PrivateNetwork> network_;
  TranscriptText transcript_;  // outlives the cell
  RobotHost host_;
  RunObserver observer_;
  SimLimit sim_limit_;
  std::optional<TableSampler> table_;
  asio::steady_timer timer_;
  asio::signal_set signals_;
  std::optional<Program> program_;
  RunReport report_;
  WallNs begin_ = 0;
  WallNs next_count_ = 0;
  bool is_over_ = false;
};

}  // namespace

RunResult run_program(const RunSettings& settings, const GoalList& goals) {
  adopt_orphans();
  return Run(settings, goals).result();
}

}  // namespace xr3
