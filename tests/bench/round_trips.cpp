// Cost of an inquiry on the robot line, compared with a bare epoll loop that answers every two
// bytes with one, in the same run: CPU time with many lines, with one inquiry and with many
// inquiries at once, the median round trip time of a single line, and how many inquiries a second
// are answered with 16 in flight, one each of 16 lines, or all of one line.
// Usage: bench_round_trips XR3 [LINES [ROUNDS [COST PIPELINED TIME RATE SINGLE_RATE]]], bounds;
// exit code 1 if a ratio is above its bound; the rates have a lower bound. The environment variable
// XR3_AGAINST may name another xr3 program, such as an older release. It then replaces the bare
// loop.
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/processes.hpp"

namespace xr3::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPipelined = 64;
constexpr std::size_t kInFlight = 16;
const std::string kInquiry = "E?";

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

void answer(int fd) {
  std::array<char, 4096> bytes;
  const ssize_t got = ::read(fd, bytes.data(), bytes.size());
  if (got <= 0) {
    ::close(fd);
    return;
  }
  std::fill_n(bytes.begin(), got / 2, ' ');
  if (::write(fd, bytes.data(), static_cast<std::size_t>(got / 2)) < 0) ::close(fd);
}

/// The minimum that a socket server must do.
[[noreturn]] void bare_loop() {
  const int listener = listen_as("bare");
  const int set = ::epoll_create1(0);
  epoll_event event{EPOLLIN, {.fd = listener}};
  ::epoll_ctl(set, EPOLL_CTL_ADD, listener, &event);
  std::array<epoll_event, 128> events;
  for (;;) {
    const int count = ::epoll_wait(set, events.data(), static_cast<int>(events.size()), -1);
    for (int i = 0; i < count; ++i) {
      const int fd = events[static_cast<std::size_t>(i)].data.fd;
      if (fd != listener) {
        answer(fd);
        continue;
      }
      epoll_event line{EPOLLIN, {.fd = ::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK)}};
      set_no_delay(line.data.fd);
      ::epoll_ctl(set, EPOLL_CTL_ADD, line.data.fd, &line);
    }
  }
}

void read_exactly(int fd, std::size_t bytes) {
  while (bytes > 0) {
    const std::size_t got = read_some(fd).size();
    if (got == 0) throw std::runtime_error("the server has closed a line");
    bytes -= got;
  }
}

/// Tells which descriptors are readable.
class Watch {
 public:
  explicit Watch(const std::vector<int>& fds) : set_(::epoll_create1(0)) {
    for (const int fd : fds) {
      epoll_event event{EPOLLIN, {.fd = fd}};
      ::epoll_ctl(set_, EPOLL_CTL_ADD, fd, &event);
    }
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() { ::close(set_); }

  /// Waits for at least one.
  std::vector<int> ready() const {
    std::array<epoll_event, kInFlight> events;
    const int count = ::epoll_wait(set_, events.data(), static_cast<int>(events.size()), -1);
    std::vector<int> fds;
    for (int i = 0; i < count; ++i) fds.push_back(events[static_cast<std::size_t>(i)].data.fd);
    return fds;
  }

 private:
  int set_;
};

/// Connected lines to one server.
class Lines {
 public:
  Lines(pid_t pid, int port, int lines) : pid_(pid) {
    for (int i = 0; i < lines; ++i) fds_.push_back(connect_to(port));
  }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
  ~Lines() {
    for (const int fd : fds_) ::close(fd);
  }

  /// CPU time of the server per inquiry, microseconds: all lines send inquiries, then all are read.
  double cost_us(int at_once, double seconds) const {
    const std::string asked = repeated(kInquiry, at_once);
    const double spent = cpu_s(pid_);
    long inquiries = 0;
    for (const auto end = Clock::now() + std::chrono::duration<double>(seconds);
         Clock::now() < end;) {
      for (const int fd : fds_) send_all(fd, asked);
      for (const int fd : fds_) read_exactly(fd, static_cast<std::size_t>(at_once));
      inquiries += static_cast<long>(fds_.size()) * at_once;
    }
    return (cpu_s(pid_) - spent) * 1e6 / static_cast<double>(inquiries);
  }

  /// The median round trip time of one line, microseconds.
  double time_us(double seconds) const {
    std::vector<double> times;
    for (const auto end = Clock::now() + std::chrono::duration<double>(seconds);
         Clock::now() < end;) {
      const auto start = Clock::now();
      send_all(fds_.front(), kInquiry);
      read_exactly(fds_.front(), 1);
      times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    return median(std::move(times));
  }

  /// Inquiries a second while 16 lines have one in flight each: a line that has its reply asks
  /// again at once.
  double rate(double seconds) const {
    const std::vector<int> asking(fds_.begin(), fds_.begin() + std::min(kInFlight, fds_.size()));
    const Watch watch(asking);
    for (const int fd : asking) send_all(fd, kInquiry);
    long inquiries = 0;
    const auto start = Clock::now();
    const auto end = start + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
      for (const int fd : watch.ready()) {
        read_exactly(fd, 1);
        send_all(fd, kInquiry);
        ++inquiries;
      }
    }
    const std::chrono::duration<double> passed = Clock::now() - start;
    for (const int fd : asking) read_exactly(fd, 1);
    return static_cast<double>(inquiries) / passed.count();
  }

  /// The same while one line has 16 inquiries in flight: it asks again for each reply.
  double single_rate(double seconds) const {
    const int fd = fds_.front();
    send_all(fd, repeated(kInquiry, kInFlight));
    long inquiries = 0;
    const auto start = Clock::now();
    const auto end = start + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
      const std::size_t replies = read_some(fd).size();
      if (replies == 0) throw std::runtime_error("the server has closed a line");
      send_all(fd, repeated(kInquiry, static_cast<int>(replies)));
      inquiries += static_cast<long>(replies);
    }
    const std::chrono::duration<double> passed = Clock::now() - start;
    read_exactly(fd, kInFlight);
    return static_cast<double>(inquiries) / passed.count();
  }

 private:
  pid_t pid_;
  std::vector<int> fds_;
};

struct Figures {
  double cost_us = 0;
  double pipelined_us = 0;
  double time_us = 0;
  double rate = 0;
  double single_rate = 0;
};

Figures measured(const Lines& lines) {
  constexpr double kSeconds = 0.25;
  return {lines.cost_us(1, kSeconds), lines.cost_us(kPipelined, kSeconds), lines.time_us(kSeconds),
          lines.rate(kSeconds), lines.single_rate(kSeconds)};
}

void print(const char* name, const Figures& figures) {
  std::printf("    %s %.2f, %.3f us of CPU, %.1f us, %.0f and %.0f a second\n", name,
              figures.cost_us, figures.pipelined_us, figures.time_us, figures.rate,
              figures.single_rate);
}

struct Bounds {
  double cost = 1.3;
  double pipelined = 3;
  double time = 1 / 0.7;
  double rate = 0.45;
  double single_rate = 0.45;
};

/// The server for comparison: the program `other`, or the bare loop if it is null.
struct Rival {
  explicit Rival(const char* other)
      : name(other != nullptr ? "the other program" : "the bare loop"),
        child(other != nullptr ? serve(other) : Child([] { bare_loop(); })),
        port(port_in(child.greeting(), other != nullptr ? "robot" : "bare")) {}

  std::string name;
  Child child;
  int port;
};

bool run(const std::string& xr3, int lines, int rounds, const Bounds& bounds) {
  const Child server = serve(xr3);
  const Rival rival(std::getenv("XR3_AGAINST"));
  const Lines ours(server.pid(), port_in(server.greeting(), "robot"), lines);
  const Lines theirs(rival.child.pid(), rival.port, lines);
  std::printf("%d lines with %d and %d inquiries at once; then a single line; %d rounds\n", lines,
              1, kPipelined, rounds);
  std::vector<double> cost;
  std::vector<double> pipelined;
  std::vector<double> time;
  std::vector<double> rate;
  std::vector<double> single_rate;
  for (int i = 0; i < rounds; ++i) {
    const Figures of_rival = measured(theirs);
    const Figures of_ours = measured(ours);
    print("rival", of_rival);
    print("xr3  ", of_ours);
    cost.push_back(of_ours.cost_us / of_rival.cost_us);
    pipelined.push_back(of_ours.pipelined_us / of_rival.pipelined_us);
    time.push_back(of_ours.time_us / of_rival.time_us);
    rate.push_back(of_rival.rate / of_ours.rate);
    single_rate.push_back(of_rival.single_rate / of_ours.single_rate);
  }
  const std::string against = " against " + rival.name;
  const bool kept[] = {
      judge(("an inquiry" + against + ", CPU").c_str(), median(cost), bounds.cost),
      judge("the same, 64 at once", median(pipelined), bounds.pipelined),
      judge(("a round trip" + against + ", time").c_str(), median(time), bounds.time),
      judge(("16 in flight" + against + ", time for one").c_str(), median(rate), 1 / bounds.rate),
      judge("the same on one line", median(single_rate), 1 / bounds.single_rate)};
  return std::all_of(std::begin(kept), std::end(kept), [](bool is_kept) { return is_kept; });
}

}  // namespace
}  // namespace xr3::bench

int main(int argc, char** argv) {
  if (argc < 2)
    return std::fputs("bench_round_trips XR3 [LINES [ROUNDS [BOUNDS...]]]\n", stderr), 2;
  const auto number = [&](int i, double otherwise) {
    return i < argc ? std::atof(argv[i]) : otherwise;
  };
  xr3::bench::prepare();
  try {
    const bool is_kept = xr3::bench::run(
        argv[1], static_cast<int>(number(2, 64)), static_cast<int>(number(3, 25)),
        {number(4, 1.3), number(5, 3), number(6, 1.1), number(7, 0.9), number(8, 0.85)});
    return is_kept ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_round_trips: %s\n", error.what()), 2;
  }
}
