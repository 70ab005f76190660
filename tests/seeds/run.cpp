#include "tests/seeds/run.hpp"

#include <algorithm>
#include <boost/system/system_error.hpp>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

#include "cell/failure.hpp"
#include "cli/options/options.hpp"
#include "server/app.hpp"
#include "tests/seeds/client.hpp"
#include "tests/seeds/log.hpp"
#include "tests/seeds/thread.hpp"
#include "tests/support/models.hpp"

namespace xr3::seeds {
namespace {

using test::robot_named;
using test::workcell_named;

constexpr std::int64_t mib(std::size_t count) { return static_cast<std::int64_t>(count) << 20; }

// Beyond --max-memory: what arrives until the next measurement, and what one answer takes.
constexpr std::int64_t kMaxBytesBeyond = mib(8);
// The library for JSON loses an object if there is no memory for a member.
constexpr std::int64_t kMaxBytesOfJson = 4096;
constexpr int kMostRuns = 10;
constexpr Ns kMaxTimeToStop = 2 * kSecond;

ModelPtr make_model(int pixels) {
  Workcell workcell = workcell_named("rhino-xr3");
  workcell.camera->pixels_x = workcell.camera->pixels_y = pixels;
  return std::make_shared<const Model>(robot_named("rhino-xr3"), workcell, Profile::kPaper);
}

/// Most runs have a small camera, for speed.
ModelPtr model_for(Random& random) {
  static const ModelPtr small = make_model(20);
  static const ModelPtr large = make_model(192);
  return random.chance(950) ? small : large;
}

Faults choose_faults(Random& random) {
  Faults faults;
  const auto sometimes = [&random](std::size_t most) {
    return random.chance(500) ? random.spread(most) : 0;
  };
  faults.again = sometimes(400);
  faults.shorter = sometimes(600);
  faults.interrupted = sometimes(300);
  faults.accept = sometimes(500);
  faults.spurious = sometimes(500);
  faults.arrival = sometimes(500);
  faults.worker = sometimes(500);
  if (random.chance(50)) faults.watch = random.spread(300);
  if (random.chance(100)) faults.socket = random.spread(300);
  faults.clock_step = random.any_of<Ns>({0, 500, 5'000, 20'000, 200'000});
  return faults;
}

class Run {
 public:
  Run(std::uint64_t seed, const RunOptions& options);
  Outcome result();

 private:
  enum class Phase : std::uint8_t { kActing, kSettling, kLeaving, kInspecting, kStopping };

  void choose_clients();
  ServeOptions serve_options();
  void serve(const ServeOptions& options, ModelPtr model);
  void check_rest(std::int64_t before);

  void idle();
  void act();
  void settle();
  void leave();
  void inspect();
  void stop();
  void enter(Phase phase);
  bool settle_clients();
  void pass_to_timer(Ns most);
  void note_harm();
  void verify(bool is_complete);
  std::string summary() const;

  std::uint64_t seed_;
  RunOptions options_;
  Random random_;
  Faults faults_;
  Kernel kernel_;
  World world_;
  std::vector<ClientPtr> clients_;
  Phase phase_ = Phase::kActing;
  std::size_t steps_ = 0;   ///< in this phase
  std::size_t most_steps_;  ///< of kActing
  std::size_t rest_ = 0;    ///< steps without progress
  Ns entered_ = 0;          ///< the phase
  bool stops_early_;
  bool jumps_;
  std::int64_t max_bytes_ = 0;  ///< of the server: its own, a share for each client
  bool has_served_ = false;
  std::optional<ExitCode> code_;
};

Run::Run(std::uint64_t seed, const RunOptions& options)
    : seed_(seed),
      options_(options),
      random_(seed),
      faults_(choose_faults(random_)),
      kernel_(random_, faults_),
      world_{random_, kernel_, model_for(random_)},
      most_steps_(random_.spread(1500)),
      stops_early_(random_.chance(150)),
      jumps_(random_.chance(300)) {
  kernel_.idle = [this] { idle(); };
  kernel_.transcript = options.transcript;
  world_.is_manual = random_.chance(750);
  world_.is_lockstep = world_.is_manual && random_.chance(250);
  world_.is_harmed = faults_.watch > 0;
  world_.has_jumped = jumps_;
  choose_clients();
}

void Run::choose_clients() {
  if (world_.is_lockstep) clients_.push_back(make_lockstep(world_));
  const bool is_alone = world_.is_manual && !world_.is_lockstep;
  const std::size_t robots = random_.below(6);
  for (std::size_t i = 0; i < robots; ++i)
    clients_.push_back(make_robot(world_, is_alone ? static_cast<char>('A' + i) : '\0'));
  for (std::size_t i = random_.below(4); i > 0; --i)
    clients_.push_back(make_monitor(world_, static_cast<int>(i)));
  for (std::size_t i = random_.below(3); i > 0; --i)
    clients_.push_back(make_websocket(world_, static_cast<int>(10 + i)));
  for (std::size_t i = random_.below(3); i > 0; --i) clients_.push_back(make_browser(world_));
  for (std::size_t i = random_.below(3); i > 0; --i) clients_.push_back(make_stranger(world_));
  max_bytes_ = mib(6) + mib(3) * static_cast<std::int64_t>(clients_.size() + 1);
}

ServeOptions Run::serve_options() {
  ServeOptions options;
  options.listen = "127.0.0.1";
  options.robot_port = world_.robot_port;
  options.monitor_port = world_.monitor_port;
  if (world_.is_manual) options.clock.mode = ClockMode::kManual;
  if (!world_.is_manual && random_.chance(300)) {
    options.line_speed = parse_line_speed(
        random_.any_of({"9600-7e2:100", "115200-8n1:1000", "300-8n1:100000", "auto:100"}));
  }
  if (!world_.is_manual && random_.chance(200)) {
    options.clock =
        parse_clock(random_.any_of({"bytes", "bytes:0", "bytes:500", "bytes:20,settle=50"}));
    options.has_concurrent_lines = !options.clock.bytes.settle_ms && random_.chance(300);
  }
  if (random_.chance(100)) options.max_lines = random_.between(1, 4);
  if (random_.chance(100)) kernel_.max_descriptors = random_.between(40, 60);
  if (random_.chance(50)) options.max_memory_mib = random_.between(2, 6);
  if (options.max_memory_mib < 10) world_.is_harmed = true;
  max_bytes_ = std::min(max_bytes_, mib(options.max_memory_mib) + kMaxBytesBeyond);
  world_.is_crowded = options.max_lines < 10 || kernel_.max_descriptors < 100;
  return options;
}

Outcome Run::result() {
  const ServeOptions options = serve_options();
  std::uint64_t failing = options_.failing_allocation;
  if (options_.chooses_failure && random_.chance(300)) failing = random_.spread(40'000);
  const std::size_t how_many = random_.chance(800) ? 1 : random_.spread(30);
  const std::int64_t before = held_bytes();
  current_kernel = &kernel_;
  start_counting(failing, how_many);
  serve(options, world_.model);
  const std::uint64_t allocations = allocation_count();
  current_kernel = nullptr;
  verify(false);
  if (has_served_ && (code_ == ExitCode::kGood || failed_allocations() == 0)) check_rest(before);
  return {kernel_.failure(), has_served_, summary(), kernel_.digest(), allocations};
}

// Without memory at its start, the process ends at once, and what Asio has begun to open stays.
// The same holds if it ends because of that later.
void Run::check_rest(std::int64_t before) {
  const std::int64_t left = held_bytes() - before;
  const bool may_leak = failed_allocations() > 0 && std::abs(left) <= kMaxBytesOfJson;
  if (left != 0 && !may_leak) kernel_.fail(std::to_string(left) + " bytes are not freed");
  if (kernel_.open_files() > 0)
    kernel_.fail(std::to_string(kernel_.open_files()) + " descriptors are left open");
  if (peak_bytes() - before > max_bytes_)
    kernel_.fail("the server held " + std::to_string(peak_bytes() - before) + " bytes");
}

void Run::serve(const ServeOptions& options, ModelPtr model) {
  const Inside inside;
  try {
    App app(options, {{std::move(model), {}}}, {});
    code_ = app.run();
  } catch (const std::bad_alloc&) {
    code_ = ExitCode::kInternal;  // main() reports it
  } catch (const FatalFailure&) {
    code_ = ExitCode::kInternal;
  } catch (const ExitError& error) {
    code_ = error.code();
    if (faults_.socket > 0 || faults_.watch > 0) return;
  } catch (const boost::system::system_error&) {
    code_ = ExitCode::kInternal;  // likewise
    if (faults_.watch > 0 && !has_served_) return;
  }
  const Outside outside;
  const std::string logged = take_logged_failure();
  if (failed_allocations() > 0) return;
  if (code_ != ExitCode::kGood) kernel_.fail("exit code " + std::to_string(as_int(*code_)));
  if (!logged.empty()) kernel_.fail("the log says: " + logged);
}

std::string Run::summary() const {
  std::ostringstream text;
  text << "seed " << seed_ << ": " << clients_.size() << " clients, "
       << (world_.is_lockstep ? "lockstep"
           : world_.is_manual ? "manual clock"
                              : "real clock")
       << ", " << allocation_count() << " allocations of which " << failed_allocations()
       << " failed, at most " << peak_bytes() << " bytes, exit code "
       << (code_ ? as_int(*code_) : -1);
  return text.str();
}

void Run::note_harm() {
  if (failed_allocations() > 0) world_.is_harmed = true;
}

void Run::verify(bool is_complete) {
  note_harm();
  for (const ClientPtr& client : clients_) client->verify(is_complete);
}

// --- What happens while the server waits.

void Run::idle() {
  has_served_ = true;
  note_harm();
  ++steps_;
  if (worker_thread().is_ready() && random_.chance(500)) return worker_thread().take_turn();
  switch (phase_) {
    case Phase::kActing: return act();
    case Phase::kSettling: return settle();
    case Phase::kLeaving: return leave();
    case Phase::kInspecting: return inspect();
    case Phase::kStopping: return stop();
  }
}

void Run::enter(Phase phase) {
  phase_ = phase;
  steps_ = rest_ = 0;
  entered_ = kernel_.now();
  if (kernel_.transcript != nullptr)
    *kernel_.transcript << "-- phase " << static_cast<int>(phase) << "\n";
}

void Run::act() {
  if (steps_ > most_steps_) {
    kernel_.end_faults();
    return enter(stops_early_ ? Phase::kStopping : Phase::kSettling);
  }
  const std::size_t choice = random_.below(100);
  if (choice < 45 && !clients_.empty()) {
    clients_[random_.below(clients_.size())]->act();
  } else if (choice < 90) {
    if (!kernel_.deliver_some()) pass_to_timer(20 * kMillisecond);
  } else if (choice < 98 || !jumps_) {
    pass_to_timer(static_cast<Ns>(random_.spread(5'000'000)));
  } else {
    kernel_.pass(static_cast<Ns>(random_.spread(86'400)) * kSecond);
  }
}

void Run::pass_to_timer(Ns most) {
  const Ns next = kernel_.next_timer();
  kernel_.pass(next <= kernel_.now() ? 0 : std::min(next - kernel_.now(), most));
}

bool Run::settle_clients() {
  bool has_moved = false;
  for (const ClientPtr& client : clients_) has_moved = client->settle() || has_moved;
  return has_moved;
}

// Until all have their replies, or nothing happens any more. Frames may arrive forever.
void Run::settle() {
  constexpr std::size_t kEnough = 200;
  kernel_.deliver_all();
  const bool has_moved = settle_clients();
  kernel_.deliver_all();
  rest_ = has_moved ? 0 : rest_ + 1;
  if (!has_moved) pass_to_timer(kSecond);
  const bool is_done = !kernel_.has_backlog() &&
                       std::all_of(clients_.begin(), clients_.end(),
                                   [](const ClientPtr& client) { return client->is_done(); });
  const bool is_over =
      steps_ > (is_done ? kEnough : 6000) || kernel_.now() - entered_ > 100 * kSecond;
  if (!is_over && (rest_ < 5 || (!is_done && rest_ < 200))) return;
  verify(true);
  for (const ClientPtr& client : clients_) client->leave();
  enter(Phase::kLeaving);
}

// A client that only listens is noticed by keepalive or by a write.
void Run::leave() {
  kernel_.deliver_all();
  if (kernel_.open_streams() == kernel_.half_closed_streams() && steps_ > 3) {
    clients_.push_back(make_inspector(world_));
    return enter(Phase::kInspecting);
  }
  steps_ % 10 == 0 ? kernel_.pass(100 * kSecond) : pass_to_timer(kSecond);
  if (steps_ < 400) return;
  kernel_.fail(std::to_string(kernel_.open_streams()) + " connections are open without clients");
  throw Failure();
}

void Run::inspect() {
  kernel_.deliver_all();
  clients_.back()->settle();
  kernel_.deliver_all();
  if (!clients_.back()->is_done() && steps_ < 3000) return;
  clients_.back()->verify(true);
  enter(Phase::kStopping);
}

void Run::stop() {
  if (!std::exchange(world_.is_stopping, true)) {
    entered_ = kernel_.now();
    return kernel_.raise(SIGTERM);
  }
  settle_clients();
  kernel_.deliver_all();
  pass_to_timer(kSecond);
  if (kernel_.now() - entered_ <= kMaxTimeToStop && steps_ < 3000) return;
  kernel_.fail("it does not stop after SIGTERM");
  throw Failure();
}

bool is_leak(const Outcome& outcome) {
  return outcome.failure.find("not freed") != std::string::npos;
}

}  // namespace

// Objects initialised once stay: only memory that later runs do not free either is a leak. (The
// allocation that fails may be one of such an object, and in the next run of another one.)
Outcome run_seed(std::uint64_t seed, const RunOptions& options) {
  const Outside outside;
  Outcome outcome = Run(seed, options).result();
  for (int runs = 1; runs < kMostRuns && is_leak(outcome); ++runs)
    outcome = Run(seed, options).result();
  return outcome;
}

}  // namespace xr3::seeds
