#include "server/pty/pump.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr int kRetryMs = 1000;

// A few pieces, so that the bytes of a program that does not read stay in its terminal.
constexpr int kPairBytes = 4096;
// All that a terminal holds, so that the line has the last bytes of a program, and its end, however
// late it reads them.
constexpr int kLastBytes = 64 * 1024;

[[noreturn]] void fail_to_watch(int error) {
  throw FileError(std::string("a pseudo-terminal cannot be watched: ") + std::strerror(error));
}

Descriptor made_inotify() {
  Descriptor inotify(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
  if (!inotify.is_open() && errno == EMFILE)
    throw FileError(
        "a pseudo-terminal cannot be watched: no instance of inotify is left for this user "
        "(fs.inotify.max_user_instances), or no descriptor for this process");
  if (!inotify.is_open()) fail_to_watch(errno);
  return inotify;
}

Descriptor made_event() {
  Descriptor event(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!event.is_open()) fail_to_watch(errno);
  return event;
}

void limit_unread(const Descriptor& socket, int bytes) {
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
}

/// While it exists, no signal interrupts this thread, nor those that it starts; a write to a closed
/// socket fails.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    ::sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  ::sigset_t before_{};
};

}  // namespace

PtyPump::PtyPump(const std::string& path, ::mode_t rights, std::function<void()> notify)
    : rights_(rights),
      notify_(std::move(notify)),
      opens_(made_inotify()),
      wake_(made_event()),
      terminal_(rights),
      link_(path, terminal_.slave()) {
  watch(terminal_);
  try {
    const SignalsBlocked blocked;
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& error) {
    fail_to_watch(error.code().value());
  }
}

PtyPump::~PtyPump() {
  close();
  thread_.join();
}

void PtyPump::close() {
  const std::scoped_lock use(shared_.use);
  shared_.is_closing = true;
  shared_.line = Descriptor();
  wake();
}

std::uint64_t PtyPump::begin_round() {
  wake();
  return ++rounds_begun_;
}

void PtyPump::wake() const { static_cast<void>(::eventfd_write(wake_.get(), 1)); }

void PtyPump::watch(const PseudoTerminal& terminal) const {
  if (::inotify_add_watch(opens_.get(), terminal.slave().c_str(), IN_OPEN) < 0)
    fail_to_watch(errno);
}

// --- The thread.

void PtyPump::run() {
  for (bool goes_on = true; goes_on;) {
    wait();
    goes_on = report(work());
    if (must_notify_ && goes_on) notify();
  }
}

// A terminal that no program has open is always ready, and a line that is not read never takes its
// bytes: then the terminal is left out.
void PtyPump::wait() {
  const auto events = [](const Flow& in, const Flow& out) {
    return static_cast<short>((in.is_empty() ? POLLIN : 0) | (out.is_empty() ? 0 : POLLOUT));
  };
  const bool has_line = line_.is_open();
  const bool can_move = has_line && !is_leaving_ && (is_open_ || bytes_.is_empty());
  const auto unless_failed = [this](bool is_watched, int descriptor) {
    return is_watched && !has_failed_ ? descriptor : -1;
  };
  std::array<::pollfd, 4> all{{
      {wake_.get(), POLLIN, 0},
      {unless_failed(!has_line, opens_.get()), POLLIN, 0},
      {unless_failed(has_line, line_.get()), events(replies_, bytes_), 0},
      {unless_failed(can_move, terminal_.master()), events(bytes_, replies_), 0},
  }};
  ::poll(all.data(), all.size(), has_failed_ || must_notify_ ? kRetryMs : -1);
  is_line_over_ = (all[2].revents & POLLHUP) != 0;
  ::eventfd_t count = 0;
  if (::eventfd_read(wake_.get(), &count) == 0) round_ += count;
}

/// Returns the exception of the pass; nullptr if there is none.
std::exception_ptr PtyPump::work() {
  try {
    pass();
    return nullptr;
  } catch (const std::exception&) {
    return std::current_exception();
  }
}

/// Returns whether the thread goes on.
bool PtyPump::report(std::exception_ptr failure) {
  const bool had_failed = std::exchange(has_failed_, failure != nullptr);
  const std::scoped_lock use(shared_.use);
  shared_.failure = std::move(failure);
  const bool has_round_ended = std::exchange(shared_.rounds_ended, round_) != round_;
  must_notify_ = must_notify_ || has_round_ended || had_failed != has_failed_;
  return !shared_.is_closing || line_.is_open();
}

void PtyPump::notify() {
  try {
    notify_();
    must_notify_ = false;
  } catch (const std::bad_alloc&) {  // tried again after a second
  }
}

void PtyPump::pass() {
  if (line_.is_open()) is_leaving_ ? await_end() : serve();
  if (line_.is_open() || is_closing()) return;
  if (is_spoilt_) renew();
  find_program();
}

bool PtyPump::is_closing() {
  const std::scoped_lock use(shared_.use);
  return shared_.is_closing;
}

// --- Programs that come and go.

// A program that has only changed the settings, such as `stty -F PATH`, is no line.
void PtyPump::find_program() {
  const bool was_opened = drain_opens();
  if (is_program_there()) return begin_line();
  if (!was_opened) return;
  prepare();
  if (is_spoilt_) return renew();
  if (is_program_there()) begin_line();
}

bool PtyPump::is_program_there() const {
  const PseudoTerminal::TerminalState state = terminal_.poll();
  return state.is_open || state.has_bytes;
}

/// Whether the slave has been opened since the last call.
bool PtyPump::drain_opens() const {
  std::array<char, 4096> events{};
  return ::read(opens_.get(), events.data(), events.size()) > 0;
}

// To make the terminal ready, the thread opens it itself, which is no program.
void PtyPump::prepare() {
  try {
    terminal_.prepare();
  } catch (const std::exception&) {
    is_spoilt_ = true;
  }
  drain_opens();
}

// The new terminal is watched before a program can find it.
void PtyPump::renew() {
  PseudoTerminal fresh(rights_);
  watch(fresh);
  link_.point_to(fresh.slave());
  terminal_ = std::move(fresh);
  is_spoilt_ = false;
}

// --- A line.

void PtyPump::begin_line() {
  std::array<int, 2> pair{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, pair.data()) != 0)
    throw FileError(std::string("a pseudo-terminal cannot be served: ") + std::strerror(errno));
  Descriptor mine(pair[0]);
  Descriptor theirs(pair[1]);
  limit_unread(mine, kPairBytes);
  limit_unread(theirs, kPairBytes);
  modes_ = terminal_.modes();
  const std::scoped_lock use(shared_.use);
  if (shared_.is_closing) return;
  shared_.changes = {{0, modes_}};
  shared_.line = std::move(theirs);
  line_ = std::move(mine);
  offset_ = 0;
  must_notify_ = true;
}

void PtyPump::serve() {
  const PseudoTerminal::TerminalState state = terminal_.poll();
  is_open_ = state.is_open;
  if (!move_replies()) return end_line(true);
  if (!is_open_) limit_unread(line_, kLastBytes);
  move_bytes(state.has_bytes);
  if (!is_open_ && !state.has_bytes && bytes_.is_empty()) leave();
}

/// Returns whether the line goes on. Replies that no program can read are discarded.
bool PtyPump::move_replies() {
  const ::ssize_t count = replies_.fill(line_.get());
  const bool has_ended = count == 0 || (count < 0 && errno != EAGAIN);
  is_open_ ? replies_.drain(terminal_.master()) : replies_.clear();
  return !has_ended && (!is_line_over_ || replies_.is_empty());
}

void PtyPump::move_bytes(bool has_bytes) {
  if (has_bytes && bytes_.is_empty()) {
    const ::ssize_t count = bytes_.fill(terminal_.master());
    if (count > 0) record_settings();
    if (count > 0) offset_ += static_cast<std::uint64_t>(count);
  }
  bytes_.drain(line_.get());
}

// Those that the terminal has after the read: so no byte acts with older ones than its own.
void PtyPump::record_settings() {
  const PtyModes now = terminal_.modes();
  if (now == modes_) return;
  const std::scoped_lock use(shared_.use);
  shared_.changes.push_back({offset_, now});
  modes_ = now;
}

// Another program may have opened the terminal since: the line goes on with it. The last bytes of
// a program may also be seen only after its hangup.
void PtyPump::leave() {
  if (is_program_there()) return;
  prepare();
  ::shutdown(line_.get(), SHUT_WR);
  is_leaving_ = true;
}

/// The terminal is ready for the next program, which waits for the end of the line.
void PtyPump::await_end() {
  const ::ssize_t count = replies_.fill(line_.get());
  const bool has_ended = count == 0 || (count < 0 && errno != EAGAIN);
  replies_.clear();
  if (has_ended) end_line(false);
}

void PtyPump::end_line(bool is_spoilt) {
  line_ = Descriptor();
  bytes_.clear();
  replies_.clear();
  is_leaving_ = false;
  is_spoilt_ = is_spoilt_ || is_spoilt;
}

::ssize_t PtyPump::Flow::fill(int from) {
  if (!is_empty()) return static_cast<::ssize_t>(end_ - begin_);
  const ::ssize_t count = ::read(from, bytes_.data(), bytes_.size());
  begin_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count;
}

void PtyPump::Flow::drain(int to) {
  if (is_empty()) return;
  const ::ssize_t count = ::write(to, &bytes_.at(begin_), end_ - begin_);
  if (count > 0) begin_ += static_cast<std::size_t>(count);
}

}  // namespace xr3
