// Cost of monitor sessions: a thousand at 60 Hz, by JSON lines and by WebSocket, compared with a
// bare loop of writes with the same bytes in the same run; and their effect on the round trip of a
// robot line, which is printed only. POSIX only. Usage: bench_fanout XR3 [SESSIONS [ROUNDS]]; exit
// code 1 if a ratio of processor times is above its bound, which leaves room for a busy machine.
#include <fcntl.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/bench/processes.hpp"

namespace xr3::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kHz = 60;
constexpr double kBound = 4;
const std::string kFollow =
    R"({"op":"sub","channel":"state","max_hz":60,"on_change":false,"fields":["joints","io"]})";

/// Reads from many connections and counts the bytes.
class Drain {
 public:
  explicit Drain(std::vector<int> fds) : fds_(std::move(fds)), epoll_(::epoll_create1(0)) {
    for (const int fd : fds_) {
      ::fcntl(fd, F_SETFL, O_NONBLOCK);
      epoll_event event{EPOLLIN, {.fd = fd}};
      ::epoll_ctl(epoll_, EPOLL_CTL_ADD, fd, &event);
    }
    thread_ = std::thread([this] { run(); });
  }
  Drain(const Drain&) = delete;
  Drain& operator=(const Drain&) = delete;
  ~Drain() {
    ends_ = true;
    thread_.join();
    for (const int fd : fds_) ::close(fd);
    ::close(epoll_);
  }
  std::uint64_t bytes() const { return bytes_; }
  const std::vector<int>& fds() const { return fds_; }

 private:
  void run() {
    stay_at(Place::kReads);
    std::vector<char> buffer(1 << 18);
    std::vector<epoll_event> events(1024);
    while (!ends_) {
      const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 50);
      for (int i = 0; i < count; ++i) {
        const ssize_t got =
            ::read(events[static_cast<std::size_t>(i)].data.fd, buffer.data(), buffer.size());
        if (got > 0) bytes_ += static_cast<std::uint64_t>(got);
      }
    }
  }

  std::vector<int> fds_;
  int epoll_;
  std::atomic<bool> ends_ = false;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::thread thread_;
};

/// CPU time of a process per message of this size, in microseconds.
double us_a_message(pid_t pid, const Drain& drain, std::size_t message_bytes, double seconds) {
  const double cpu = cpu_s(pid);
  const std::uint64_t bytes = drain.bytes();
  pass(seconds);
  const double messages =
      static_cast<double>(drain.bytes() - bytes) / static_cast<double>(message_bytes);
  return (cpu_s(pid) - cpu) * 1e6 / messages;
}

/// Writes the same bytes to all connections 60 times per second.
[[noreturn]] void write_loop(int viewers, const std::string& message) {
  const int listener = listen_as("bare");
  std::vector<int> fds;
  for (int i = 0; i < viewers; ++i) {
    fds.push_back(::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK));
    set_no_delay(fds.back());
  }
  const std::chrono::microseconds period(1'000'000 / kHz);
  for (auto next = Clock::now();; next = std::max(next + period, Clock::now() - period)) {
    std::this_thread::sleep_until(next);
    for (const int fd : fds)
      if (::write(fd, message.data(), message.size()) < 0 && errno != EAGAIN) std::_Exit(1);
  }
}

std::string masked_frame(const std::string& text) {
  std::string frame = "\x81";
  frame += static_cast<char>(0x80 | text.size());  // below 126
  return frame + std::string(4, '\0') + text;      // a mask of zeros changes nothing
}

const std::string kHandshake =
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    "Sec-WebSocket-Protocol: xr3.v1\r\n\r\n";

enum class Transport { kLines, kWebsocket };

void send_text(int fd, Transport transport, const std::string& text) {
  send_all(fd, transport == Transport::kLines ? text + "\n" : masked_frame(text));
}

/// A monitor session without a subscription.
int open_session(int port, Transport transport) {
  const int fd = connect_to(port);
  if (transport == Transport::kWebsocket) {
    send_all(fd, kHandshake);
    if (read_some(fd).find(" 101 ") == std::string::npos) throw std::runtime_error("no WebSocket");
  }
  return fd;
}

template <class Connect>
std::vector<int> many(int viewers, const Connect& connect) {
  std::vector<int> fds;
  for (int i = 0; i < viewers; ++i) fds.push_back(connect());
  return fds;
}

/// A message that the server sends repeatedly, with its line end.
std::string sample(int port) {
  const int fd = open_session(port, Transport::kLines);
  send_text(fd, Transport::kLines, kFollow);
  std::string all;
  while (std::count(all.begin(), all.end(), '\n') < 4) all += read_some(fd);
  ::close(fd);
  std::istringstream lines(all);
  std::string line;
  while (std::getline(lines, line) && line.find(R"("op":"state")") == std::string::npos) {
  }
  return line + "\n";
}

/// Round trips of an inquiry: their 99th percentile in microseconds.
double line_p99_us(int port, double seconds) {
  const int fd = connect_to(port);
  std::vector<double> times;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    const auto start = Clock::now();
    send_all(fd, "E?");
    read_some(fd);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    std::this_thread::sleep_for(std::chrono::microseconds(400));
  }
  ::close(fd);
  std::sort(times.begin(), times.end());
  return times[times.size() * 99 / 100];
}

// --- Three senders that send the same to the same number of connections, in turn.

/// A process that sends to all connections between start() and stop().
class Sender {
 public:
  /// `message_bytes` is the size of a message on the wire.
  Sender(pid_t pid, std::size_t message_bytes) : pid_(pid), message_bytes_(message_bytes) {}
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  virtual ~Sender() = default;
  virtual void start() = 0;
  virtual void stop() = 0;

  /// CPU time per message while sending, in microseconds.
  double measure(double seconds) const {
    return us_a_message(pid_, *drain_, message_bytes_, seconds);
  }

 protected:
  pid_t pid() const { return pid_; }
  std::optional<Drain> drain_;

 private:
  pid_t pid_;
  std::size_t message_bytes_;
};

class BareLoop : public Sender {
 public:
  BareLoop(pid_t pid, std::vector<int> fds, std::size_t message_bytes)
      : Sender(pid, message_bytes) {
    drain_.emplace(std::move(fds));
  }
  void start() override { ::kill(pid(), SIGCONT); }
  void stop() override { ::kill(pid(), SIGSTOP); }
};

class Server : public Sender {
 public:
  Server(pid_t pid, int port, int viewers, Transport transport, std::size_t message_bytes)
      : Sender(pid, message_bytes), port_(port), viewers_(viewers), transport_(transport) {}
  void start() override {
    std::vector<int> fds = many(viewers_, [this] { return open_session(port_, transport_); });
    for (const int fd : fds) send_text(fd, transport_, kFollow);
    drain_.emplace(std::move(fds));
  }
  void stop() override { drain_.reset(); }

 private:
  int port_;
  int viewers_;
  Transport transport_;
};

/// Results of a round, in microseconds.
struct Round {
  double bare = 0;
  double lines = 0;
  double websocket = 0;
  double alone = 0;   ///< p99 of the robot line
  double beside = 0;  ///< the same with monitor sessions by JSON lines
};

constexpr double kSettle_s = 0.2;

double turn_of(Sender& sender, double seconds) {
  sender.start();
  pass(kSettle_s);
  const double us = sender.measure(seconds);
  sender.stop();
  pass(kSettle_s);
  return us;
}

double line_beside(Sender& sender, int robot_port, double seconds) {
  sender.start();
  pass(kSettle_s);
  const double us = line_p99_us(robot_port, seconds);
  sender.stop();
  pass(kSettle_s);
  return us;
}

template <class Value>
double median_of(const std::vector<Round>& rounds, const Value& value) {
  std::vector<double> all;
  for (const Round& round : rounds) all.push_back(value(round));
  return median(std::move(all));
}

/// The minimum for the line: other processes on the machine can only add delay.
Round best(const std::vector<Round>& rounds) {
  Round found = rounds.front();
  for (const Round& round : rounds) {
    found.alone = std::min(found.alone, round.alone);
    found.beside = std::min(found.beside, round.beside);
  }
  return found;
}

/// The ratio in each round, so that both values were measured under the same load.
template <class Value, class Base>
double ratio(const std::vector<Round>& rounds, const Value& value, const Base& base) {
  return median_of(rounds, [&](const Round& round) { return value(round) / base(round); });
}

bool report(const std::vector<Round>& rounds) {
  const auto bare = [](const Round& round) { return round.bare; };
  const auto lines = [](const Round& round) { return round.lines; };
  const auto websocket = [](const Round& round) { return round.websocket; };
  const Round line = best(rounds);
  std::printf("medians: bare write loop %.2f us per message, JSON lines %.2f, WebSocket %.2f\n",
              median_of(rounds, bare), median_of(rounds, lines), median_of(rounds, websocket));
  std::printf("robot line, p99 of a round trip: %.0f us alone, %.0f us with the sessions\n",
              line.alone, line.beside);
  const bool kept[] = {judge("JSON lines against the bare loop, CPU per message",
                             ratio(rounds, lines, bare), kBound),
                       judge("WebSocket against the bare loop, CPU per message",
                             ratio(rounds, websocket, bare), kBound)};
  return kept[0] && kept[1];
}

bool run(const std::string& xr3, int viewers, int rounds) {
  const Child server = serve(xr3);
  const std::string greeting = server.greeting();
  const int monitor = port_in(greeting, "monitor");
  const int robot = port_in(greeting, "robot");
  const std::string message = sample(monitor);
  std::printf("%d monitor sessions at %d Hz, %zu bytes per message, %d rounds\n", viewers, kHz,
              message.size(), rounds);
  const Child loop([&] { write_loop(viewers, message); });
  const int bare_port = port_in(loop.greeting(), "bare");
  BareLoop bare(loop.pid(), many(viewers, [=] { return connect_to(bare_port); }), message.size());
  Server lines(server.pid(), monitor, viewers, Transport::kLines, message.size());
  // A header of four bytes instead of a line end.
  Server websocket(server.pid(), monitor, viewers, Transport::kWebsocket, message.size() + 3);
  pass(kSettle_s);
  bare.stop();
  std::vector<Round> found;
  for (int i = 0; i < rounds; ++i) {
    Round round;
    round.bare = turn_of(bare, 1);
    round.lines = turn_of(lines, 1);
    round.websocket = turn_of(websocket, 1);
    round.alone = line_p99_us(robot, 1);
    round.beside = line_beside(lines, robot, 1);
    std::printf("    bare %.2f  lines %.2f  WebSocket %.2f us; robot line %.0f, %.0f us\n",
                round.bare, round.lines, round.websocket, round.alone, round.beside);
    found.push_back(round);
  }
  return report(found);
}

}  // namespace
}  // namespace xr3::bench

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("bench_fanout XR3 [SESSIONS [ROUNDS]]\n", stderr), 2;
  xr3::bench::prepare();
  try {
    const bool is_kept = xr3::bench::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 1000,
                                         argc > 3 ? std::atoi(argv[3]) : 5);
    return is_kept ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_fanout: %s\n", error.what()), 2;
  }
}
