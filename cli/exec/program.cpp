#include "cli/exec/program.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/asio/write.hpp>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

extern char** environ;

#include "cli/exec/pipe.hpp"
#include "cli/exec/throw_errno.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

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
  return name == "PATH" || name == "LANG" || name.starts_with("LC_") || name == "TZ" ||
         name == "TERM";
}

std::vector<std::string> environment_of(const ProgramSettings& settings) {
  std::vector<std::string> all;
  for (char** each = environ; *each != nullptr; ++each)
    if (is_passed_on(*each, settings.is_stranger)) all.emplace_back(*each);
  for (const auto& [name, value] : settings.environment)
    all.emplace_back(name).append("=").append(value);
  return all;
}

/// Leaves the program its standard input and outputs only. Not every socket of this process closes
/// by itself.
void close_others_at_exec() {
  constexpr int kFirst = STDERR_FILENO + 1;
  constexpr int kMost = 65'536;
  if (::syscall(SYS_close_range, kFirst, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
  for (int each = kFirst; each < kMost; ++each) ::fcntl(each, F_SETFD, FD_CLOEXEC);
}

void limit(int resource, std::size_t most) {
  if (most == 0) return;
  const rlimit both{most, most};
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &both) != 0) ::_exit(127);
}

/// The standard streams of a program. Without input the pipe is closed: it ends at once.
struct StandardPipes {
  Pipe input;
  Pipe output;
  Pipe error;
};

/// In the child: everything between fork and exec. Only async-signal-safe calls.
void become_program(const ProgramSettings& settings, const StandardPipes& pipes, ::pid_t parent) {
  constexpr std::size_t kMib = std::size_t{1} << 20U;
  ::setsid();  // and so no terminal of this process
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it has ended meanwhile
  for (const int each : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) ::signal(each, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(pipes.input.reading.get(), STDIN_FILENO);
  ::dup2(pipes.output.writing.get(), STDOUT_FILENO);
  ::dup2(pipes.error.writing.get(), STDERR_FILENO);
  if (settings.network != nullptr && !settings.network->enter()) ::_exit(127);
  limit(RLIMIT_AS, settings.max_memory_mib * kMib);
  limit(RLIMIT_NPROC, settings.max_processes);
  close_others_at_exec();
}

/// Starts the program. The error of exec comes back by a pipe that exec closes.
::pid_t start(const ProgramSettings& settings, const StandardPipes& pipes) {
  const Arguments arguments(settings.command);
  const std::vector<std::string> environment = environment_of(settings);
  const Arguments variables(environment);
  Pipe result;
  const ::pid_t parent = ::getpid();
  const ::pid_t child = ::fork();
  if (child < 0) throw_errno("fork");
  if (child == 0) {
    become_program(settings, pipes, parent);
    ::execvpe(arguments.pointers[0], arguments.pointers.data(), variables.pointers.data());
    const int error = errno;
    [[maybe_unused]] const auto sent = ::write(result.writing.get(), &error, sizeof error);
    ::_exit(127);
  }
  result.writing = Descriptor();
  int error = 0;
  if (::read(result.reading.get(), &error, sizeof error) == sizeof error) {
    ::waitpid(child, nullptr, 0);
    errno = error;
    throw_errno(settings.command.front());
  }
  return child;
}

int open_pidfd(::pid_t process) {
  const auto descriptor = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) throw_errno("pidfd_open");
  return descriptor;
}

}  // namespace

std::string to_text(const ProgramEnd& end) {
  if (end.signal == 0) return "exit code " + std::to_string(end.code);
  return "signal " + std::to_string(end.signal) + " (" + ::strsignal(end.signal) + ")";
}

Program::Program(asio::io_context& io, const ProgramSettings& settings, Output output)
    : pid_(0),
      ended_(io),
      input_(io),
      output_{STDOUT_FILENO, asio::posix::stream_descriptor(io), {}},
      error_{STDERR_FILENO, asio::posix::stream_descriptor(io), {}},
      on_output_(std::move(output)) {
  assert(!settings.command.empty());
  StandardPipes pipes;
  if (!settings.has_input) pipes.input.writing = Descriptor();
  pid_ = start(settings, pipes);
  ended_.assign(open_pidfd(pid_));
  output_.pipe.assign(pipes.output.reading.release());
  error_.pipe.assign(pipes.error.reading.release());
  read(output_);
  read(error_);
  if (!settings.has_input) return;
  from_.emplace(io);
  input_.assign(pipes.input.writing.release());
  spawn_session(io.get_executor(), "the standard input", copy_input(), [] {});
}

Program::~Program() {
  if (end_) return;
  signal(SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Program::on_end(std::function<void(const ProgramEnd&)> ended) {
  on_end_ = std::move(ended);
  ended_.async_wait(asio::posix::stream_descriptor::wait_read, [this](ErrorCode cancelled) {
    if (!cancelled) reap();
  });
}

void Program::reap() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  end_ = ProgramEnd{WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                    WIFSIGNALED(status) ? WTERMSIG(status) : 0};
  on_end_(*end_);
}

void Program::read(OutputPipe& from) {
  from.pipe.async_read_some(asio::buffer(from.buffer),
                            [this, &from](ErrorCode error, std::size_t count) {
                              if (error == asio::error::operation_aborted) return;
                              if (error) return from.pipe.close();  // its last process has ended
                              on_output_(from.stream, {from.buffer.data(), count});
                              read(from);
                            });
}

asio::awaitable<void> Program::copy_input() {
  for (;;) {
    const std::string_view bytes = co_await from_->read();
    if (bytes.empty()) break;
    const auto [error, count] = co_await asio::async_write(input_, asio::buffer(bytes), kAwait);
    if (error) break;  // the program has closed it
  }
  input_.close();
}

void Program::signal(int number) const { ::kill(-pid_, number); }

bool Program::has_group() const { return ::kill(-pid_, 0) == 0; }

}  // namespace xr3
