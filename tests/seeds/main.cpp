// Runs many seeds, on all processors, or one of them. See `seeds --help`.
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <thread>
#include <utility>
#include <vector>

#include "tests/seeds/log.hpp"
#include "tests/seeds/run.hpp"

namespace xr3::seeds {
namespace {

constexpr time_t kMaxSeconds = 10;  // for one seed
constexpr std::uint64_t kMaxFailures = 10;
// Exit codes of a process that works.
constexpr int kWithoutMemory = 77;
constexpr int kNotReusable = 78;

// Where an exception may not leave, such as in the destructor of a JSON value, which allocates, a
// process without memory must end.
[[noreturn]] void end_without_memory() {
  if (failed_allocations() > 0) ::_exit(kWithoutMemory);
  std::abort();
}

/// Of the processor's time: the machine may be busy.
void limit_time() {
  const itimerval limit{{}, {kMaxSeconds, 0}};
  ::setitimer(ITIMER_PROF, &limit, nullptr);
}

struct Arguments {
  std::uint64_t count = 100'000;
  std::uint64_t from = 0;
  std::uint64_t seed = 0;
  std::uint64_t failing = kNoFailure;
  std::uint64_t sites_of = 0;
  std::uint64_t every = 1;
  unsigned jobs = 1;
  std::string program;
};

/// A worker's progress, in shared memory: it remains readable if the worker dies.
struct Progress {
  std::uint64_t seed;
  std::uint64_t done;
  std::uint64_t failed;
  std::uint64_t aborted;  ///< without memory
};

std::string repetition(const Arguments& arguments, std::uint64_t seed) {
  return "repeat it: " + arguments.program + " --seed " + std::to_string(seed);
}

Outcome run_one(const Arguments& arguments, std::uint64_t seed) {
  limit_time();
  const Outcome outcome = run_seed(seed);
  if (outcome.failure.empty()) return outcome;
  std::clog << "seed " + std::to_string(seed) + " fails: " + outcome.failure + "\n  " +
                   repetition(arguments, seed) + "\n";
  return outcome;
}

/// The seeds of one process of many. It goes on where a former one has ended.
void work(const Arguments& arguments, Progress& progress) {
  const std::uint64_t last = arguments.from + arguments.count;
  while (progress.seed < last && progress.failed < kMaxFailures) {
    const Outcome outcome = run_one(arguments, progress.seed);
    ++progress.done;
    progress.seed += arguments.jobs;
    if (!outcome.failure.empty()) ++progress.failed;
    if (!outcome.has_served) ::_exit(kNotReusable);
  }
}

/// A process that works.
pid_t start(const Arguments& arguments, Progress& progress) {
  const pid_t worker = ::fork();
  if (worker != 0) return worker;
  std::set_terminate(end_without_memory);
  work(arguments, progress);
  ::_exit(0);
}

struct Worker {
  pid_t id;
  Progress* progress;
};

/// A run has ended its process, unless memory was missing: then it may.
void note_end(const Arguments& arguments, int status, Progress& progress) {
  ++progress.done;
  const std::uint64_t seed = std::exchange(progress.seed, progress.seed + arguments.jobs);
  const bool may_end = WIFEXITED(status) && WEXITSTATUS(status) == kWithoutMemory;
  ++(may_end ? progress.aborted : progress.failed);
  if (may_end) return;
  std::clog << "seed " << seed << " ends the process: status " << status
            << (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF ? ", it hangs" : "") << "\n  "
            << repetition(arguments, seed) << "\n";
}

/// A process has ended. Returns whether another one takes its place.
bool goes_on(const Arguments& arguments, int status, Progress& progress) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return false;
  const bool is_renewed = WIFEXITED(status) && WEXITSTATUS(status) == kNotReusable;
  if (!is_renewed) note_end(arguments, status, progress);
  return true;
}

void wait_for_all(const Arguments& arguments, std::vector<Worker>& workers) {
  while (!workers.empty()) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    const auto worker = std::find_if(workers.begin(), workers.end(),
                                     [ended](const Worker& each) { return each.id == ended; });
    if (goes_on(arguments, status, *worker->progress)) {
      worker->id = start(arguments, *worker->progress);
    } else {
      workers.erase(worker);
    }
  }
}

void report(const Progress& all, double seconds) {
  std::clog << all.done << " seeds in " << seconds << " s, "
            << static_cast<std::uint64_t>(static_cast<double>(all.done) / seconds) << " a second; "
            << all.aborted << " ended the process for want of memory: "
            << (all.failed == 0 ? "all good" : "FAILED") << "\n";
}

int run_many(const Arguments& arguments) {
  const std::size_t bytes = arguments.jobs * sizeof(Progress);
  void* const shared =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return 1;
  auto* const progress = static_cast<Progress*>(shared);
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Worker> workers;
  for (unsigned i = 0; i < arguments.jobs; ++i) {
    progress[i].seed = arguments.from + i;
    workers.push_back({start(arguments, progress[i]), progress + i});
  }
  wait_for_all(arguments, workers);
  Progress all{};
  for (unsigned i = 0; i < arguments.jobs; ++i) {
    all.done += progress[i].done;
    all.failed += progress[i].failed;
    all.aborted += progress[i].aborted;
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  report(all, time.count());
  return all.failed == 0 ? 0 : 1;
}

/// Twice, to see whether it is the same run.
int show(const Arguments& arguments) {
  RunOptions options;
  options.transcript = &std::clog;
  options.failing_allocation = arguments.failing;
  options.chooses_failure = arguments.failing == kNoFailure;
  show_failing_stacks(true);
  const Outcome outcome = run_seed(arguments.seed, options);
  options.transcript = nullptr;
  show_failing_stacks(false);
  const bool is_same = run_seed(arguments.seed, options).digest == outcome.digest;
  std::clog << outcome.summary << (is_same ? "" : "; a second run differs") << "\n"
            << (outcome.failure.empty() ? "good" : "FAILED: " + outcome.failure) << "\n";
  return outcome.failure.empty() ? 0 : 1;
}

/// In a process of its own, since it may end. Returns whether nothing went wrong.
bool run_site(const Arguments& arguments, std::uint64_t site) {
  const pid_t worker = ::fork();
  if (worker == 0) {
    std::set_terminate(end_without_memory);
    limit_time();
    const Outcome outcome =
        run_seed(arguments.sites_of, {.chooses_failure = false, .failing_allocation = site});
    if (!outcome.failure.empty()) std::clog << outcome.failure << "\n";
    ::_exit(outcome.failure.empty() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(worker, &status, 0);
  return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kWithoutMemory);
}

/// Lets every allocation of one seed fail in turn.
int walk_sites(const Arguments& arguments) {
  const std::uint64_t count = run_seed(arguments.sites_of, {.chooses_failure = false}).allocations;
  int failed = 0;
  for (std::uint64_t site = 0; site < count; site += arguments.every) {
    if (run_site(arguments, site)) continue;
    ++failed;
    std::clog << "allocation " << site << "\n  " << repetition(arguments, arguments.sites_of)
              << " --failing " << site << "\n";
  }
  std::clog << count << " allocations, " << failed << " failures go wrong\n";
  return failed == 0 ? 0 : 1;
}

/// The server's output: LISTENING lines, and addresses of the page. That of this program goes to
/// std::clog.
void discard_output() {
  std::cout.setstate(std::ios::badbit);
  std::cerr.setstate(std::ios::badbit);
}

}  // namespace
}  // namespace xr3::seeds

int main(int argc, char** argv) {
  using namespace xr3::seeds;
  Arguments arguments;
  arguments.program = argv[0];
  arguments.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App app("Runs the whole server in memory, with clients and misfortunes from a seed.");
  app.add_option("--count", arguments.count, "the number of seeds");
  app.add_option("--from", arguments.from, "the first seed");
  app.add_option("--jobs", arguments.jobs, "processes")->check(CLI::PositiveNumber);
  const auto* seed = app.add_option("--seed", arguments.seed, "runs this seed, with a transcript");
  app.add_option("--failing", arguments.failing, "with --seed: this allocation fails");
  const auto* sites =
      app.add_option("--sites", arguments.sites_of, "lets each allocation of this seed fail");
  app.add_option("--every", arguments.every, "with --sites: only every n-th allocation");
  CLI11_PARSE(app, argc, argv);
  const Outside outside;
  std::signal(SIGPIPE, SIG_IGN);
  replace_log();
  discard_output();
  if (seed->count() > 0) return show(arguments);
  return sites->count() > 0 ? walk_sites(arguments) : run_many(arguments);
}
