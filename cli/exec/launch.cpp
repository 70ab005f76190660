#include "cli/exec/launch.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

#include "cli/exec/private_network.hpp"
#include "cli/exec/system_calls.hpp"
#include "cli/exec/throw_errno.hpp"

namespace xr3 {
namespace {

// The descriptors of a child before exec, beside its standard streams.
constexpr int kResult = 3;  // an error as errno, or kNoNamespace; closed by exec
constexpr int kStatus = 4;  // the wait status of the program, from its keeper
constexpr int kFirstOther = 5;

constexpr int kNoNamespace = -1;

/// The arguments of execvpe(), which must not be made after the fork.
struct Arguments {
  explicit Arguments(const std::vector<std::string>& texts) {
    for (const std::string& each : texts) pointers.push_back(const_cast<char*>(each.c_str()));
    pointers.push_back(nullptr);
  }
  std::vector<char*> pointers;
};

bool is_passed_on(std::string_view variable, bool to_stranger) {
  const std::string_view name = variable.substr(0, variable.find('='));
  if (!to_stranger) return !name.starts_with("XR3_");
  constexpr std::string_view kNames[] = {
      "PATH",           "TZ",           "TERM",        "LANG",     "LANGUAGE",
      "LC_ALL",         "LC_ADDRESS",   "LC_COLLATE",  "LC_CTYPE", "LC_IDENTIFICATION",
      "LC_MEASUREMENT", "LC_MESSAGES",  "LC_MONETARY", "LC_NAME",  "LC_NUMERIC",
      "LC_PAPER",       "LC_TELEPHONE", "LC_TIME"};
  return std::ranges::count(kNames, name) > 0;
}

std::vector<std::string> environment_of(const ProgramSettings& settings) {
  std::vector<std::string> all;
  for (char** each = environ; *each != nullptr; ++each)
    if (is_passed_on(*each, settings.is_stranger)) all.emplace_back(*each);
  for (const auto& [name, value] : settings.environment)
    all.emplace_back(name).append("=").append(value);
  return all;
}

/// Everything that a child needs; after the fork no memory can be allocated.
struct Launch {
  Launch(const ProgramSettings& the_settings, const StandardPipes& the_pipes)
      : settings(the_settings), pipes(the_pipes) {}

  const ProgramSettings& settings;
  const StandardPipes& pipes;
  Arguments arguments{settings.command};
  std::vector<std::string> environment = environment_of(settings);
  Arguments variables{environment};
  IdMaps maps;
  Pipe result;
  Pipe status;
};

// --- In the child: only async-signal-safe calls.

[[noreturn]] void give_up(int error) {
  [[maybe_unused]] const auto sent = ::write(kResult, &error, sizeof error);
  ::_exit(127);
}

/// Closes every descriptor of this process but the standard streams, kResult and kStatus.
void arrange_descriptors(const Launch& launch) {
  constexpr int kMost = 65'536;
  const int result = ::fcntl(launch.result.writing.get(), F_DUPFD, kFirstOther);
  const int status = ::fcntl(launch.status.writing.get(), F_DUPFD, kFirstOther);
  ::dup2(launch.pipes.input.reading.get(), STDIN_FILENO);
  ::dup2(launch.pipes.output.writing.get(), STDOUT_FILENO);
  ::dup2(launch.pipes.error.writing.get(), STDERR_FILENO);
  ::dup3(result, kResult, O_CLOEXEC);
  ::dup3(status, kStatus, O_CLOEXEC);
  if (::syscall(SYS_close_range, kFirstOther, ~0U, 0U) == 0) return;
  for (int each = kFirstOther; each < kMost; ++each) ::close(each);
}

/// Leaves the session of the judge: no terminal of the judge, and none of its handlers. Ends with
/// the judge.
void leave_judge(const Launch& launch) {
  for (const int each : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) ::signal(each, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const ProgramSettings& its = launch.settings;
  const bool is_in =
      its.network == nullptr || ((!its.user || its.user->enter()) && its.network->enter());
  arrange_descriptors(launch);
  if (!is_in) give_up(errno);
  ::setsid();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd judge{kResult, 0, 0};
  if (::poll(&judge, 1, 0) != 0) ::_exit(127);  // the judge has ended meanwhile
}

/// Limits the tasks. The system counts those of a user in each user namespace separately.
void limit_tasks(std::size_t most) {
  if (most == 0) return;
  const rlimit both{most, most};
  if (::setrlimit(RLIMIT_NPROC, &both) != 0) give_up(errno);
}

/// Limits files. The system has limits for a user, such as of watched files, that one program must
/// not use up.
void limit_files() {
  constexpr rlimit kFiles{256, 256};
  if (::setrlimit(RLIMIT_NOFILE, &kFiles) != 0) give_up(errno);
}

[[noreturn]] void become_program(const Launch& launch, bool has_user_namespace) {
  if (has_user_namespace) limit_tasks(launch.settings.max_tasks);
  const bool is_sandboxed = launch.settings.network != nullptr;
  if (is_sandboxed) limit_files();
  if (is_sandboxed && !restrict_system_calls()) give_up(errno);
  if (!is_sandboxed && launch.settings.user && !launch.settings.user->enter()) give_up(errno);
  ::execvpe(launch.arguments.pointers[0], launch.arguments.pointers.data(),
            launch.variables.pointers.data());
  give_up(errno);
}

/// Forks, with new namespaces, and without the handlers that need locks.
::pid_t fork_with(unsigned long namespaces) {
  return static_cast<::pid_t>(::syscall(SYS_clone, namespaces | SIGCHLD, 0, 0, 0, 0));
}

/// Mounts a view of the namespace's own processes. Containers may not mount it: then the outer one
/// stays.
void mount_proc() {
  if (::mount(nullptr, "/", nullptr, MS_SLAVE | MS_REC, nullptr) == 0)
    ::mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr);
}

/// The first process of a PID namespace: starts the program, waits for it, and reports its status.
[[noreturn]] void keep_program(const Launch& launch, bool has_user) {
  leave_judge(launch);
  if (has_user && !launch.maps.write()) give_up(kNoNamespace);
  mount_proc();
  const ::pid_t program = fork_with(0);
  if (program < 0) give_up(errno);
  if (program == 0) become_program(launch, has_user);
  ::syscall(SYS_close_range, 0U, static_cast<unsigned>(kResult), 0U);
  int status = 0;
  while (::waitpid(-1, &status, 0) != program) {
  }
  [[maybe_unused]] const auto sent = ::write(kStatus, &status, sizeof status);
  ::_exit(0);
}

[[noreturn]] void run_child(const Launch& launch, unsigned long namespaces) {
  if (namespaces != 0) keep_program(launch, (namespaces & CLONE_NEWUSER) != 0);
  leave_judge(launch);
  become_program(launch, launch.settings.network != nullptr);
}

// --- In the judge.

/// Starts the program in these namespaces; nullopt if the system does not allow them.
std::optional<Launched> try_launch(const ProgramSettings& settings, const StandardPipes& pipes,
                                   unsigned long namespaces) {
  Launch launch(settings, pipes);
  const ::pid_t child = fork_with(namespaces);
  if (child < 0 && namespaces != 0) return std::nullopt;
  if (child < 0) throw_errno("fork");
  if (child == 0) run_child(launch, namespaces);
  launch.result.writing = Descriptor();
  launch.status.writing = Descriptor();
  int error = 0;
  if (::read(launch.result.reading.get(), &error, sizeof error) != sizeof error)
    return Launched{child, namespaces != 0, std::move(launch.status.reading)};
  ::waitpid(child, nullptr, 0);
  if (error == kNoNamespace) return std::nullopt;
  errno = error;
  throw_errno(settings.command.front());
}

}  // namespace

Launched launch(const ProgramSettings& settings, const StandardPipes& pipes) {
  constexpr unsigned long kProcesses = CLONE_NEWPID | CLONE_NEWNS;
  if (settings.network == nullptr)  // bubblewrap makes its own
    for (const unsigned long namespaces : {kProcesses, kProcesses | CLONE_NEWUSER})
      if (auto launched = try_launch(settings, pipes, namespaces)) return std::move(*launched);
  return *try_launch(settings, pipes, 0);
}

}  // namespace xr3
