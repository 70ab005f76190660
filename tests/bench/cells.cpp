// How long replies take while every cell has a moving robot and a client that asks 20 times a
// second, compared with a bare epoll loop under the same load in the same run: what the loop's
// replies take is the machine's part. The clients ask at times that are spread at random (the same
// in each run). A reply has the time of its arrival in the kernel, so that a late client is not a
// late server. Linux only. Usage: bench_cells XR3 [CELLS [SECONDS [BOUND_MS [OPTION...]]]], with
// options of `xr3 serve`. Exit code 1 if more than 1 of 100 replies take longer than the bound and
// than five times what the loop's take: on a busy machine those are late, too. Nothing is judged if
// the server had to wait for a processor for more than a fifth of the time.
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/processes.hpp"

namespace xr3::bench {
namespace {

using Ns = std::int64_t;

constexpr Ns kSecond = 1'000'000'000;
constexpr Ns kPeriod = kSecond / 20;
constexpr Ns kWarmUp = kSecond;
constexpr long kMoveEvery = 10;  // inquiries
constexpr double kMost_ms = 50;  // before a client asks again
constexpr double kLikeTheLoop = 5;
constexpr double kBusy = 0.2;
constexpr std::string_view kInquiry = "E?";
constexpr std::string_view kThere = "E+60\rD-60\rC+60\rE?";
constexpr std::string_view kBack = "E-60\rD+60\rC-60\rE?";
constexpr double kNsPerMs = 1e6;
constexpr double kNsPerSecond = 1e9;
constexpr int kSpareLines = 16;

Ns now_ns(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

/// The robot of each client always moves: 60 counts take longer than 10 inquiries.
std::string_view text_of(long inquiry) {
  if (inquiry % kMoveEvery != 0) return kInquiry;
  return inquiry / kMoveEvery % 2 == 0 ? kThere : kBack;
}

/// Time in which the main thread of a process was ready to run, and others had the processors.
double queued_s(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/schedstat");
  double ran_ns = 0;
  double waited_ns = 0;
  file >> ran_ns >> waited_ns;
  return waited_ns / kNsPerSecond;
}

struct Client {
  int fd = -1;
  Ns phase = 0;    ///< of its inquiries within the period
  long asked = 0;  ///< inquiries
  Ns sent = 0;     ///< by the wall clock; 0: no reply is awaited
};

struct Figures {
  std::vector<Ns> waits;  ///< sorted
  long late = 0;          ///< inquiries that were not sent, since the last one had no reply
  double load = 0;        ///< of the server, in processors
  double queued = 0;      ///< part of the time in which the server waited for a processor of others

  double ms(double rank) const {
    const auto at = static_cast<std::size_t>(rank * static_cast<double>(waits.size()));
    return static_cast<double>(waits.at(std::min(at, waits.size() - 1))) / kNsPerMs;
  }
};

/// Clients of one server.
class Load {
 public:
  Load(pid_t pid, int port, int clients) : pid_(pid), epoll_(::epoll_create1(0)) {
    std::mt19937 random(1);
    std::uniform_int_distribution<Ns> phases(0, kPeriod - 1);
    for (int i = 0; i < clients; ++i)
      clients_.push_back({open_line(port), phases(random), i % kMoveEvery});
    std::sort(clients_.begin(), clients_.end(),
              [](const Client& a, const Client& b) { return a.phase < b.phase; });
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      epoll_event event{EPOLLIN, {.u64 = i}};
      ::epoll_ctl(epoll_, EPOLL_CTL_ADD, clients_[i].fd, &event);
    }
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;
  ~Load() {
    for (const Client& each : clients_) ::close(each.fd);
    ::close(epoll_);
  }

  Figures measure(double seconds) {
    figures_ = {};
    start_ = now_ns(CLOCK_MONOTONIC);
    run_until(start_ + kWarmUp);
    figures_ = {};
    const double cpu = cpu_s(pid_);
    const double queued = queued_s(pid_);
    const Ns began = now_ns(CLOCK_MONOTONIC);
    run_until(began + static_cast<Ns>(seconds * kNsPerSecond));
    const double passed = static_cast<double>(now_ns(CLOCK_MONOTONIC) - began) / kNsPerSecond;
    figures_.load = (cpu_s(pid_) - cpu) / passed;
    figures_.queued = (queued_s(pid_) - queued) / passed;
    std::sort(figures_.waits.begin(), figures_.waits.end());
    return figures_;
  }

 private:
  static int open_line(int port) {
    const int fd = connect_to(port);
    const int on = 1;
    ::setsockopt(fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
    return fd;
  }

  void run_until(Ns end) {
    for (Ns now = 0; (now = now_ns(CLOCK_MONOTONIC)) < end;) {
      while (next_due() <= now) ask();
      const Ns wait = std::clamp<Ns>(next_due() - now_ns(CLOCK_MONOTONIC), 0, kPeriod);
      const timespec timeout{0, wait};
      const int count = ::epoll_pwait2(epoll_, events_.data(), static_cast<int>(events_.size()),
                                       &timeout, nullptr);
      for (int i = 0; i < count; ++i)
        receive(clients_[events_[static_cast<std::size_t>(i)].data.u64]);
    }
  }

  Ns next_due() const { return start_ + round_ * kPeriod + clients_[next_].phase; }

  void ask() {
    Client& client = clients_[next_];
    if (++next_ == clients_.size()) {
      next_ = 0;
      ++round_;
    }
    if (client.sent != 0) {
      ++figures_.late;
      return;
    }
    const std::string_view text = text_of(client.asked++);
    client.sent = now_ns(CLOCK_REALTIME);
    if (::send(client.fd, text.data(), text.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(text.size()))
      throw std::runtime_error("cannot send");
  }

  void receive(Client& client) {
    std::array<char, 64> bytes;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> notes;
    iovec into{bytes.data(), bytes.size()};
    msghdr message{};
    message.msg_iov = &into;
    message.msg_iovlen = 1;
    message.msg_control = notes.data();
    message.msg_controllen = notes.size();
    const ssize_t got = ::recvmsg(client.fd, &message, MSG_DONTWAIT);
    if (got < 0 && errno == EAGAIN) return;
    const cmsghdr* note = CMSG_FIRSTHDR(&message);
    if (got != 1 || note == nullptr || client.sent == 0)
      throw std::runtime_error("a reply is not one byte");
    timespec arrived{};
    std::memcpy(&arrived, CMSG_DATA(note), sizeof arrived);
    figures_.waits.push_back(arrived.tv_sec * kSecond + arrived.tv_nsec - client.sent);
    client.sent = 0;
  }

  pid_t pid_;
  int epoll_;
  std::vector<Client> clients_;
  std::size_t next_ = 0;  ///< the client that asks next
  Ns round_ = 0;
  Ns start_ = 0;
  Figures figures_;
  std::array<epoll_event, 256> events_{};
};

/// Answers each read with one byte: the minimum that a server must do.
[[noreturn]] void answer_all() {
  const int listener = listen_as("bare");
  const int set = ::epoll_create1(0);
  epoll_event event{EPOLLIN, {.fd = listener}};
  ::epoll_ctl(set, EPOLL_CTL_ADD, listener, &event);
  std::array<epoll_event, 128> events;
  std::array<char, 4096> bytes;
  for (;;) {
    const int count = ::epoll_wait(set, events.data(), static_cast<int>(events.size()), -1);
    for (int i = 0; i < count; ++i) {
      const int fd = events[static_cast<std::size_t>(i)].data.fd;
      if (fd == listener) {
        epoll_event line{EPOLLIN, {.fd = ::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK)}};
        set_no_delay(line.data.fd);
        ::epoll_ctl(set, EPOLL_CTL_ADD, line.data.fd, &line);
      } else if (::read(fd, bytes.data(), bytes.size()) <= 0 || ::write(fd, " ", 1) < 0) {
        ::close(fd);
      }
    }
  }
}

Child serve_cells(const std::string& xr3, int cells, const std::vector<std::string>& options) {
  std::vector<std::string> all{"--cell-per-connection", "--max-cells", std::to_string(cells),
                               "--max-lines", std::to_string(cells + kSpareLines)};
  all.insert(all.end(), options.begin(), options.end());
  return serve(xr3, all);
}

void print(const char* name, const Figures& of) {
  std::printf(
      "  %s: half within %.3f ms, 99 of 100 within %.3f, 999 of 1000 within %.3f, all within "
      "%.1f\n",
      name, of.ms(0.5), of.ms(0.99), of.ms(0.999), of.ms(1));
  std::printf(
      "    %zu replies, %ld inquiries too late; ran %.0f %% of the time, waited for a processor "
      "%.1f %%\n",
      of.waits.size(), of.late, 100 * of.load, 100 * of.queued);
}

bool run(const std::string& xr3, int cells, double seconds, double bound_ms,
         const std::vector<std::string>& options) {
  std::printf("%d cells, a client each that asks 20 times a second, moving robots\n", cells);
  double of_loop_ms = 0;
  {
    const Child loop([] { answer_all(); });
    Load load(loop.pid(), port_in(loop.greeting(), "bare"), cells);
    const Figures figures = load.measure(seconds);
    print("bare loop", figures);
    of_loop_ms = figures.ms(0.99);
  }
  const Child server = serve_cells(xr3, cells, options);
  Load load(server.pid(), port_in(server.greeting(), "robot"), cells);
  const Figures figures = load.measure(seconds);
  print("xr3", figures);
  if (figures.queued > kBusy)
    return std::puts("not judged: other programs had the processors"), true;
  return judge("99 of 100 replies, ms", figures.ms(0.99),
               std::max(bound_ms, kLikeTheLoop * of_loop_ms));
}

}  // namespace
}  // namespace xr3::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_cells XR3 [CELLS [SECONDS [BOUND_MS [OPTION...]]]]\n");
    return 2;
  }
  try {
    xr3::bench::prepare();
    const int cells = argc > 2 ? std::atoi(argv[2]) : 1000;
    const double seconds = argc > 3 ? std::atof(argv[3]) : 10;
    const double bound_ms = argc > 4 ? std::atof(argv[4]) : xr3::bench::kMost_ms;
    const std::vector<std::string> options(argv + std::min(argc, 5), argv + argc);
    return xr3::bench::run(argv[1], cells, seconds, bound_ms, options) ? 0 : 1;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
