#include "cli/exec/pool.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <exception>
#include <limits>
#include <utility>

#include "cli/exec/descendants.hpp"
#include "cli/exec/pipe.hpp"
#include "cli/exec/throw_errno.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

struct Job {
  std::size_t index;
  ::pid_t process;
  Descriptor pipe;
  WallNs deadline;
  std::string text;
};

/// Runs a task in the child; never returns.
[[noreturn]] void work(const std::function<std::string(std::size_t)>& task, std::size_t index,
                       int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  bool is_good = false;
  try {
    is_good = write_all(pipe, task(index));
  } catch (const std::exception& error) {
    print_error(std::string("xr3: ") + error.what() + "\n");
  }
  ::_exit(is_good ? 0 : 1);
}

Job start(const std::function<std::string(std::size_t)>& task, std::size_t index, WallNs limit,
          const StopSignals* stop) {
  Pipe ends;
  const ::pid_t process = ::fork();
  if (process < 0) throw_errno("fork");
  if (process == 0) {
    ends.reading = Descriptor();
    if (stop != nullptr) stop->release();
    work(task, index, ends.writing.get());
  }
  const WallNs deadline = limit > 0 ? wall_now() + limit : kNever;
  return {index, process, std::move(ends.reading), deadline, {}};
}

/// Reads what has arrived. Returns false at the end.
bool read_some(Job& job) {
  std::array<char, 65536> buffer;
  const ::ssize_t count = ::read(job.pipe.get(), buffer.data(), buffer.size());
  if (count > 0) job.text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

/// Waits for the end of a process. Returns whether it succeeded.
bool finish(Job& job) {
  job.pipe = Descriptor();
  int status = 0;
  while (::waitpid(job.process, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Milliseconds until the first deadline; -1 if there is none.
int until_deadline(const std::vector<Job>& jobs) {
  constexpr WallNs kMs = 1'000'000;
  const WallNs first = std::ranges::min_element(jobs, {}, &Job::deadline)->deadline;
  if (first == kNever) return -1;
  const WallNs left_ms = (first - wall_now()) / kMs + 1;
  return static_cast<int>(std::clamp<WallNs>(left_ms, 0, std::numeric_limits<int>::max()));
}

void wait_for_any(const std::vector<Job>& jobs, const StopSignals* stop,
                  std::vector<pollfd>& watched) {
  watched.clear();
  for (const Job& job : jobs) watched.push_back({job.pipe.get(), POLLIN, 0});
  if (stop != nullptr) watched.push_back({stop->descriptor(), POLLIN, 0});
  if (::poll(watched.data(), watched.size(), until_deadline(jobs)) < 0 && errno != EINTR)
    throw_errno("poll");
}

/// Whether a job continues after poll() has returned these events for it.
bool goes_on(Job& job, short events) {
  if (wall_now() >= job.deadline) {
    ::kill(job.process, SIGKILL);  // stopped, or held up
    return false;
  }
  return events == 0 || read_some(job);
}

/// Lets a job end its program.
void end(Job& job) {
  constexpr WallNs kStopLimit = 20'000'000'000;
  ::kill(job.process, SIGTERM);
  job.deadline = std::min(job.deadline, wall_now() + kStopLimit);
}

}  // namespace

std::vector<std::optional<std::string>> in_processes(
    std::size_t count, std::size_t jobs, WallNs limit,
    const std::function<std::string(std::size_t)>& task,
    const std::function<void(std::size_t)>& done, StopSignals* stop) {
  assert(jobs > 0);
  adopt_orphans();  // orphans of a process that failed
  std::vector<std::optional<std::string>> results(count);
  std::vector<Job> running;
  std::vector<pollfd> watched;
  std::size_t next = 0;
  bool is_stopped = false;
  while (next < count || !running.empty()) {
    while (next < count && running.size() < jobs)
      running.push_back(start(task, next++, limit, stop));
    wait_for_any(running, stop, watched);
    if (stop != nullptr && stop->take()) {
      is_stopped = true;
      next = count;
      std::ranges::for_each(running, end);
    }
    for (std::size_t i = running.size(); i-- > 0;) {
      if (goes_on(running[i], watched[i].revents)) continue;
      Job job = std::move(running[i]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      const bool is_good = finish(job);
      if (is_stopped) continue;
      if (is_good) results[job.index] = std::move(job.text);
      done(job.index);
    }
  }
  end_children(wall_now() + kKillLimit, 0);
  return results;
}

}  // namespace xr3
