#include "server/pty/watch.hpp"

#include <sys/epoll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxEvents = 16;
constexpr std::uint32_t kAlways = EPOLLIN | EPOLLET;
constexpr int kRetryMs = 1000;
constexpr WallNs kRetryEvery = kRetryMs * WallNs{1'000'000};

[[noreturn]] void fail_to_watch(int error) {
  throw FileError(std::string("a pseudo-terminal cannot be watched: ") + std::strerror(error));
}

/// Reads what a descriptor has, which is not needed.
void discard(int descriptor) {
  std::array<char, 4096> events{};
  [[maybe_unused]] const ::ssize_t count = ::read(descriptor, events.data(), events.size());
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

PtyWatch::PtyWatch(const std::vector<std::string>& paths, ::mode_t rights)
    : set_(::epoll_create1(EPOLL_CLOEXEC)), opens_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (!set_.is_open() || !opens_.is_open()) fail_to_watch(errno);
  for (const int each : {requests_.descriptor(), opens_.get()})
    if (!control(EPOLL_CTL_ADD, each, EPOLLIN, nullptr)) fail_to_watch(errno);
  for (const std::string& path : paths) watch(places_.emplace_back(path, rights));
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

void PtyWatch::watch(PtyPlace& place) {
  const PseudoTerminal& terminal = place.terminal();
  if (!control(EPOLL_CTL_ADD, terminal.master(), kAlways, &place) ||
      ::inotify_add_watch(opens_.get(), terminal.slave().c_str(), IN_OPEN) < 0)
    fail_to_watch(errno);
}

bool PtyWatch::control(int how, int descriptor, std::uint32_t events, PtyPlace* place) const {
  epoll_event event{};
  event.events = events;
  event.data.ptr = place;
  return ::epoll_ctl(set_.get(), how, descriptor, &event) == 0;
}

void PtyWatch::attend(PtyPlace& place) {
  place.request();
  requests_.give();
}

std::uint64_t PtyWatch::attend_to_all() {
  for (PtyPlace& place : places_) place.request();
  const std::uint64_t round = ++requested_;
  requests_.give();
  return round;
}

void PtyWatch::await_room(PtyPlace& place) {
  place.request_room();
  requests_.give();
}

// --- The thread.

void PtyWatch::run() {
  while (!is_stopping_ && failure_ == 0) {
    wait();
    retry();
  }
  news_.give();
}

void PtyWatch::wait() {
  std::array<epoll_event, kMaxEvents> events{};
  const int count =
      ::epoll_wait(set_.get(), events.data(), kMaxEvents, retry_at_ == kNever ? -1 : kRetryMs);
  if (count < 0 && errno != EINTR) failure_ = errno;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    auto* const place = static_cast<PtyPlace*>(event.data.ptr);
    place == nullptr ? take_own_events() : handle(*place, event.events);
  }
}

void PtyWatch::retry() {
  if (wall_now() < retry_at_) return;
  retry_at_ = kNever;
  for (PtyPlace& place : places_)
    if (place.stage() == PtyPlace::Stage::kFailed) {
      renew(place);
      move_on(place);
    }
}

// A place that is requested meanwhile is attended to again: the signal follows the request. After
// an open, all places without a line are looked at.
void PtyWatch::take_own_events() {
  requests_.take();
  discard(opens_.get());
  const std::uint64_t round = requested_;
  for (PtyPlace& place : places_) answer(place);
  if (attended_.exchange(round) != round) news_.give();
}

void PtyWatch::answer(PtyPlace& place) {
  if (place.take_room_request())
    control(EPOLL_CTL_MOD, place.terminal().master(), kAlways | EPOLLOUT, &place);
  if (place.take_request() || place.stage() == PtyPlace::Stage::kIdle) move_on(place);
}

void PtyWatch::handle(PtyPlace& place, std::uint32_t events) {
  if ((events & EPOLLOUT) != 0) control(EPOLL_CTL_MOD, place.terminal().master(), kAlways, &place);
  move_on(place);
}

void PtyWatch::move_on(PtyPlace& place) {
  if (place.stage() == PtyPlace::Stage::kDropped) renew(place);
  const PtyPlace::Stage before = place.stage();
  place.attend();
  if (place.stage() == PtyPlace::Stage::kArrived && before != PtyPlace::Stage::kArrived)
    news_.give();
}

void PtyWatch::renew(PtyPlace& place) {
  const bool is_again = place.stage() == PtyPlace::Stage::kFailed;
  try {
    place.renew();
    watch(place);
  } catch (const std::exception&) {
    place.fail();
    retry_at_ = wall_now() + kRetryEvery;
  }
  if (is_again != (place.stage() == PtyPlace::Stage::kFailed)) news_.give();
}

}  // namespace xr3
