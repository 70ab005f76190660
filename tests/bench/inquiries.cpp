// The inquiries that a server answers in a second of its processor time, beside a bare epoll loop
// that answers every two bytes with one, and beside redis where it is installed; then how evenly
// the replies are shared among lines that all ask again as soon as they have their reply. The
// ratios to the loop, and the fairness among 1,000 lines, have floors; other rows are printed only.
// Usage: bench_inquiries XR3 [--quick]; exit code 1 if a floor is broken. With --quick few lines
// ask for a short time, and nothing is judged.
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/processes.hpp"

namespace xr3::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWarmUp_s = 0.1;
constexpr const char* kMaxLines = "10100";

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

/// A server whose replies have one length.
struct Peer {
  pid_t pid = 0;
  int port = 0;
  std::string inquiry = "E?";
  std::size_t reply_bytes = 1;
};

int free_port() {
  return port_in(Child([] { listen_as("free"); }).greeting(), "free");
}

bool can_connect(int port) {
  try {
    ::close(connect_to(port));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

bool has_redis() { return std::system("command -v redis-server >/dev/null") == 0; }

[[noreturn]] void exec_redis(int port) {
  ::close(STDOUT_FILENO);
  ::execlp("redis-server", "redis-server", "--bind", "127.0.0.1", "--save", "", "--maxclients",
           kMaxLines, "--port", std::to_string(port).c_str(), nullptr);
  std::_Exit(1);
}

/// Lines to one server. Each sends some inquiries at once, and again when it has all replies.
class Lines {
 public:
  Lines(const Peer& peer, int lines, int in_flight)
      : in_flight_(in_flight),
        replies_bytes_(peer.reply_bytes * static_cast<std::size_t>(in_flight)) {
    for (int i = 0; i < in_flight; ++i) inquiries_ += peer.inquiry;
    for (int i = 0; i < lines; ++i) {
      lines_.push_back({connect_to(peer.port)});
      epoll_event event{EPOLLIN, {.u64 = static_cast<std::uint64_t>(i)}};
      ::epoll_ctl(set_, EPOLL_CTL_ADD, lines_.back().fd, &event);
    }
    for (Line& line : lines_) ask(line);
    replies(kWarmUp_s);
  }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
  /// Resets the connections, so that their ports are free again.
  ~Lines() {
    const linger reset{1, 0};
    for (const Line& line : lines_) {
      ::setsockopt(line.fd, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
      ::close(line.fd);
    }
    ::close(set_);
  }

  /// The number of replies to each line in this time.
  std::vector<long> replies(double seconds) {
    for (Line& line : lines_) line.replies = 0;
    std::vector<epoll_event> events(lines_.size());
    for (const auto end = Clock::now() + std::chrono::duration<double>(seconds);
         Clock::now() < end;) {
      const int count = ::epoll_wait(set_, events.data(), static_cast<int>(events.size()), 100);
      for (int i = 0; i < count; ++i) receive(lines_[events[static_cast<std::size_t>(i)].data.u64]);
    }
    std::vector<long> all;
    for (const Line& line : lines_) all.push_back(line.replies);
    return all;
  }

 private:
  struct Line {
    int fd = -1;
    std::size_t awaited_bytes = 0;
    long replies = 0;
  };

  void ask(Line& line) {
    send_all(line.fd, inquiries_);
    line.awaited_bytes = replies_bytes_;
  }

  void receive(Line& line) {
    const ssize_t got = ::read(line.fd, buffer_.data(), buffer_.size());
    if (got <= 0) throw std::runtime_error("the server has closed a line");
    line.awaited_bytes -= static_cast<std::size_t>(got);
    if (line.awaited_bytes > 0) return;
    line.replies += in_flight_;
    ask(line);
  }

  int in_flight_;
  std::string inquiries_;
  std::size_t replies_bytes_;
  int set_ = ::epoll_create1(0);
  std::vector<Line> lines_;
  std::array<char, 4096> buffer_{};
};

/// Inquiries that a server answers in a second of its processor time.
double rate(const Peer& peer, int lines, int in_flight, double seconds) {
  Lines asking(peer, lines, in_flight);
  const double spent = cpu_s(peer.pid);
  const std::vector<long> replies = asking.replies(seconds);
  return static_cast<double>(std::accumulate(replies.begin(), replies.end(), 0L)) /
         (cpu_s(peer.pid) - spent);
}

struct Peers {
  Peer epoll;
  Peer xr3;
  std::optional<Peer> redis;
};

struct Scale {
  int divisor = 1;  ///< of the numbers of lines
  int rounds = 5;
  double rate_s = 0.5;
  double fairness_s = 10;
  bool is_judged = true;
};

constexpr Scale kQuick{50, 1, 0.05, 0.2, false};

bool is_kept(double value, std::optional<double> floor) { return !floor || value >= *floor; }

std::string floor_text(double value, std::optional<double> floor) {
  if (!floor) return "-";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.2f%s", *floor, is_kept(value, floor) ? "" : " BROKEN");
  return text.data();
}

/// A row of the table of rates: medians of all rounds, in which the servers take turns.
bool compare(const Peers& peers, int lines, int in_flight, std::optional<double> floor,
             const Scale& scale) {
  std::vector<double> epoll;
  std::vector<double> xr3;
  std::vector<double> redis;
  std::vector<double> ratios;
  for (int i = 0; i < scale.rounds; ++i) {
    epoll.push_back(rate(peers.epoll, lines, in_flight, scale.rate_s));
    xr3.push_back(rate(peers.xr3, lines, in_flight, scale.rate_s));
    if (peers.redis) redis.push_back(rate(*peers.redis, lines, in_flight, scale.rate_s));
    ratios.push_back(xr3.back() / epoll.back());
  }
  const double ratio = median(ratios);
  const std::string of_redis =
      peers.redis ? std::to_string(std::lround(median(redis))) : "not installed";
  std::printf("| %d | %d | %.0f | %.0f | %s | %.2f | %s |\n", lines, in_flight, median(epoll),
              median(xr3), of_redis.c_str(), ratio, floor_text(ratio, floor).c_str());
  return is_kept(ratio, floor);
}

/// A row of the table of fairness. Returns the fewest replies over the most.
double share(const char* name, const Peer& peer, int lines, std::optional<double> floor,
             double seconds) {
  Lines asking(peer, lines, 1);
  const std::vector<long> replies = asking.replies(seconds);
  const auto [fewest, most] = std::minmax_element(replies.begin(), replies.end());
  const double shared = static_cast<double>(*fewest) / static_cast<double>(std::max(*most, 1L));
  std::printf("| %s | %d | %ld | %ld | %.2f | %s |\n", name, lines, *fewest, *most, shared,
              floor_text(shared, floor).c_str());
  return shared;
}

bool rates(const Peers& peers, const Scale& scale) {
  std::printf(
      "Inquiries in a second of the server's processor time, median of %d:\n\n"
      "| lines | in flight on each | epoll | xr3 | redis | xr3 / epoll | floor |\n"
      "|---|---|---|---|---|---|---|\n",
      scale.rounds);
  const auto floor = [&](double least) {
    return scale.is_judged ? std::optional(least) : std::nullopt;
  };
  const int many = scale.divisor;
  const bool kept[] = {compare(peers, 50, 1, floor(0.7), scale),
                       compare(peers, 50, 16, floor(0.45), scale),
                       compare(peers, 1000 / many, 1, floor(0.5), scale),
                       compare(peers, 10'000 / many, 1, std::nullopt, scale)};
  return std::all_of(std::begin(kept), std::end(kept), [](bool each) { return each; });
}

/// The best of three rounds counts.
bool fairness(const Peers& peers, const Scale& scale) {
  constexpr double kFloor = 0.5;
  constexpr int kRounds = 3;
  std::printf(
      "\nReplies to each line in %.1f s:\n\n"
      "| server | lines | fewest | most | fewest / most | floor, best of %d |\n"
      "|---|---|---|---|---|---|\n",
      scale.fairness_s, kRounds);
  share("epoll", peers.epoll, 1000 / scale.divisor, std::nullopt, scale.fairness_s);
  double best = 0;
  for (int i = 0; i < kRounds && best < kFloor; ++i)
    best = std::max(best, share("xr3", peers.xr3, 1000 / scale.divisor, kFloor, scale.fairness_s));
  for (const int lines : {4'000, 10'000}) {
    share("epoll", peers.epoll, lines / scale.divisor, std::nullopt, scale.fairness_s);
    share("xr3", peers.xr3, lines / scale.divisor, std::nullopt, scale.fairness_s);
  }
  return best >= kFloor;
}

bool run(const std::string& xr3, const Scale& scale) {
  const Child loop([] { bare_loop(); });
  const Child server = serve(xr3, {"--max-lines", kMaxLines});
  Peers peers{{loop.pid(), port_in(loop.greeting(), "bare")},
              {server.pid(), port_in(server.greeting(), "robot")},
              std::nullopt};
  std::optional<Child> redis;
  if (has_redis()) {
    const int port = free_port();
    redis.emplace([=] { exec_redis(port); });
    while (!can_connect(port)) pass(kWarmUp_s);
    peers.redis = Peer{redis->pid(), port, "PING\r\n", std::string_view("+PONG\r\n").size()};
  }
  const bool are_rates_kept = rates(peers, scale);
  const bool is_fair = fairness(peers, scale);
  return !scale.is_judged || (are_rates_kept && is_fair);
}

}  // namespace
}  // namespace xr3::bench

int main(int argc, char** argv) {
  const bool is_quick = argc == 3 && std::string_view(argv[2]) == "--quick";
  if (argc != 2 && !is_quick) return std::fputs("bench_inquiries XR3 [--quick]\n", stderr), 2;
  xr3::bench::prepare();
  try {
    return xr3::bench::run(argv[1], is_quick ? xr3::bench::kQuick : xr3::bench::Scale{}) ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_inquiries: %s\n", error.what()), 2;
  }
}
