#include "cli/exec/program.hpp"

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/asio/write.hpp>
#include <cassert>
#include <csignal>
#include <cstring>
#include <system_error>

#include "cli/exec/launch.hpp"
#include "cli/exec/throw_errno.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

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
  Launched launched = launch(settings, pipes);
  pid_ = launched.process;
  has_keeper_ = launched.is_keeper;
  status_ = std::move(launched.status);
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
  int its = 0;
  if (::read(status_.get(), &its, sizeof its) == sizeof its) status = its;
  end_ = ProgramEnd{WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                    WIFSIGNALED(status) ? WTERMSIG(status) : 0};
  on_end_(*end_);
}

void Program::read(OutputPipe& from) {
  from.pipe.async_read_some(asio::buffer(from.buffer),
                            [this, &from](ErrorCode error, std::size_t count) {
                              if (error == asio::error::operation_aborted) return;
                              // The last process with the pipe has ended.
                              if (error) return from.pipe.close();
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
