#include "server/pty/watch.hpp"

#include <sys/epoll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxEvents = 4;
constexpr std::uint32_t kAlways = EPOLLIN | EPOLLET;
constexpr int kRetryMs = 1000;
constexpr WallNs kRetryEvery = kRetryMs * WallNs{1'000'000};

[[noreturn]] void fail_to_watch(int error) {
  throw FileError(std::string("a pseudo-terminal cannot be watched: ") + std::strerror(error));
}

Descriptor made_set() {
  Descriptor set(::epoll_create1(EPOLL_CLOEXEC));
  if (!set.is_open()) fail_to_watch(errno);
  return set;
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

/// While it exists, no signal interrupts this thread, nor those that it starts.
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

PtyWatch::PtyWatch(const std::string& path, ::mode_t rights)
    : rights_(rights), set_(made_set()), opens_(made_inotify()), place_(path, rights) {
  for (const int each : {requests_.descriptor(), opens_.get()})
    if (!control(EPOLL_CTL_ADD, each, EPOLLIN)) fail_to_watch(errno);
  watch(place_.terminal());
  try {
    const SignalsBlocked blocked;
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& error) {
    fail_to_watch(error.code().value());
  }
}

PtyWatch::~PtyWatch() {
  is_stopping_ = true;
  requests_.give();
  thread_.join();
}

void PtyWatch::watch(const PseudoTerminal& terminal) const {
  if (!control(EPOLL_CTL_ADD, terminal.master(), kAlways) ||
      ::inotify_add_watch(opens_.get(), terminal.slave().c_str(), IN_OPEN) < 0)
    fail_to_watch(errno);
}

bool PtyWatch::control(int how, int descriptor, std::uint32_t events) const {
  epoll_event event{};
  event.events = events;
  return ::epoll_ctl(set_.get(), how, descriptor, &event) == 0;
}

std::uint64_t PtyWatch::begin_round() {
  const std::uint64_t round = ++begun_;
  poll_soon();
  return round;
}

void PtyWatch::await_room() {
  is_room_requested_ = true;
  poll_soon();
}

// --- The thread.

void PtyWatch::run() {
  while (!is_stopping_ && error_ == 0) {
    wait();
    update();
  }
  news_.give();
}

// Whatever has woken the thread, it looks at everything.
void PtyWatch::wait() {
  std::array<epoll_event, kMaxEvents> events{};
  const int timeout = retry_at_ == kNever ? -1 : kRetryMs;
  const int count = ::epoll_wait(set_.get(), events.data(), kMaxEvents, timeout);
  if (count < 0 && errno != EINTR) error_ = errno;
  const bool has_room = std::any_of(events.begin(), events.begin() + std::max(count, 0),
                                    [](const auto& each) { return (each.events & EPOLLOUT) != 0; });
  if (has_room) control(EPOLL_CTL_MOD, place_.terminal().master(), kAlways);
}

// A signal follows each request, so that one which comes meanwhile is not missed.
void PtyWatch::update() {
  requests_.take();
  const std::uint64_t round = begun_;
  if (is_room_requested_.exchange(false))
    control(EPOLL_CTL_MOD, place_.terminal().master(), kAlways | EPOLLOUT);
  if (is_renewal_due()) renew();
  poll();
  if (ended_.exchange(round) != round) news_.give();
}

/// Whether a program has opened the terminal since the last call.
bool PtyWatch::take_opens() const {
  std::array<char, 4096> events{};
  return ::read(opens_.get(), events.data(), events.size()) > 0;
}

// To make the terminal ready, the thread opens it itself. This is no program, but one may have come
// at the same time.
void PtyWatch::poll() {
  const auto has_arrived = [this] { return place_.stage() == PtyPlace::Stage::kArrived; };
  const bool had_arrived = has_arrived();
  if (take_opens()) place_.note_opened();
  if (place_.poll()) {
    take_opens();
    place_.poll();
  }
  if (place_.stage() == PtyPlace::Stage::kDropped) poll_soon();
  if (has_arrived() && !had_arrived) news_.give();
}

bool PtyWatch::is_renewal_due() const {
  return place_.stage() == PtyPlace::Stage::kDropped || wall_now() >= retry_at_;
}

// The new terminal is watched before a program can find it.
void PtyWatch::renew() {
  const bool had_failed = place_.stage() == PtyPlace::Stage::kFailed;
  retry_at_ = kNever;
  try {
    PseudoTerminal fresh(rights_);
    watch(fresh);
    place_.replace(std::move(fresh));
  } catch (const std::exception&) {
    place_.fail();
    retry_at_ = wall_now() + kRetryEvery;
  }
  if (had_failed != (place_.stage() == PtyPlace::Stage::kFailed)) news_.give();
}

}  // namespace xr3
