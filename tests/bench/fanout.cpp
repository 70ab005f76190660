// What a viewer costs: a thousand of them at 60 Hz, by JSON lines and by WebSocket, against a bare loop of
// writes with the same bytes in the same run; and what they do to the round trip of a robot line beside
// them. It speaks POSIX only. Usage: bench_fanout XR3 [VIEWERS [ROUNDS [LINES_BOUND WEBSOCKET_BOUND
// LINE_BOUND]]]; exit code 1 where a ratio is above its bound.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kHz = 60;
const std::string kFollow =
    R"({"op":"sub","channel":"state","max_hz":60,"on_change":false,"fields":["joints","io"]})";

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot connect");
  const int on = 1;
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return fd;
}

void send_all(int fd, const std::string& bytes) {
  if (::send(fd, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("cannot send");
}

/// Keeps who measures, who is measured and who reads apart, where there are processors enough: a wake-up
/// would otherwise put a client where the server is busy, and the scheduler's slice would be measured.
enum class Place { kMeasures = 0, kServes = 1, kReads = 2 };
void stay_at(Place place) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  if (processors < 3) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<int>(place), &set);
  ::sched_setaffinity(0, sizeof set, &set);
}

/// User and system time of a process, seconds.
double cpu_s(pid_t pid) {
  clockid_t clock = 0;
  timespec spent{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &spent) != 0)
    throw std::runtime_error("no processor time of a child");
  return static_cast<double>(spent.tv_sec) + static_cast<double>(spent.tv_nsec) * 1e-9;
}

/// A child process that is ended with this value.
class Child {
 public:
  template <class Run>
  explicit Child(const Run& run) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      stay_at(Place::kServes);
      run();
      std::_Exit(0);
    }
    ::close(ends[1]);
    out_ = ends[0];
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    ::close(out_);
  }
  pid_t pid() const { return pid_; }
  /// Its first line.
  std::string greeting() const {
    std::string line;
    for (char c = 0; ::read(out_, &c, 1) == 1 && c != '\n';) line += c;
    return line;
  }

 private:
  pid_t pid_ = 0;
  int out_ = -1;
};

int port_in(const std::string& greeting, const std::string& name) {
  const std::size_t at = greeting.find(name + "=");
  if (at == std::string::npos) throw std::runtime_error("not started: " + greeting);
  return std::atoi(greeting.c_str() + greeting.find(':', at) + 1);
}

/// Reads everything that comes on many connections, and counts bytes.
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

void pass(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// CPU time of a process for each message of so many bytes, in microseconds.
double us_a_message(pid_t pid, const Drain& drain, std::size_t message_bytes, double seconds) {
  const double cpu = cpu_s(pid);
  const std::uint64_t bytes = drain.bytes();
  pass(seconds);
  const double messages =
      static_cast<double>(drain.bytes() - bytes) / static_cast<double>(message_bytes);
  return (cpu_s(pid) - cpu) * 1e6 / messages;
}

/// One write of the same bytes to everybody, 60 times a second.
[[noreturn]] void write_loop(int viewers, const std::string& message) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(listener, reinterpret_cast<sockaddr*>(&address), size);
  ::listen(listener, 4096);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  std::printf("LISTENING bare=127.0.0.1:%d\n", ntohs(address.sin_port));
  std::fflush(stdout);
  std::vector<int> fds;
  for (int i = 0; i < viewers; ++i) {
    fds.push_back(::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK));
    const int on = 1;
    ::setsockopt(fds.back(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
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

std::string read_some(int fd) {
  std::string bytes(65536, '\0');
  const ssize_t got = ::read(fd, bytes.data(), bytes.size());
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

enum class Carrier { kLines, kWebsocket };

void say(int fd, Carrier carrier, const std::string& text) {
  send_all(fd, carrier == Carrier::kLines ? text + "\n" : masked_frame(text));
}

/// A viewer who follows nothing yet.
int look(int port, Carrier carrier) {
  const int fd = connect_to(port);
  if (carrier == Carrier::kWebsocket) {
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

/// What one viewer is sent again and again, with its line end.
std::string sample(int port) {
  const int fd = look(port, Carrier::kLines);
  say(fd, Carrier::kLines, kFollow);
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

// --- Three that send the same to as many viewers, by turns.

/// Somebody who sends to all of a thousand connections between start() and stop().
class Sender {
 public:
  /// `message_bytes` are those of each message, on the wire.
  Sender(pid_t pid, std::size_t message_bytes) : pid_(pid), message_bytes_(message_bytes) {}
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  virtual ~Sender() = default;
  virtual void start() = 0;
  virtual void stop() = 0;

  /// CPU time a message while it sends, in microseconds.
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
  Server(pid_t pid, int port, int viewers, Carrier carrier, std::size_t message_bytes)
      : Sender(pid, message_bytes), port_(port), viewers_(viewers), carrier_(carrier) {}
  void start() override {
    std::vector<int> fds = many(viewers_, [this] { return look(port_, carrier_); });
    for (const int fd : fds) say(fd, carrier_, kFollow);
    drain_.emplace(std::move(fds));
  }
  void stop() override { drain_.reset(); }

 private:
  int port_;
  int viewers_;
  Carrier carrier_;
};

/// What one round found, in microseconds.
struct Round {
  double bare = 0;
  double lines = 0;
  double websocket = 0;
  double alone = 0;   ///< p99 of the robot line
  double beside = 0;  ///< the same beside viewers by JSON lines
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
double median(const std::vector<Round>& rounds, const Value& value) {
  std::vector<double> all;
  for (const Round& round : rounds) all.push_back(value(round));
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

/// The line's best: neighbours on the machine can only make it wait.
Round best(const std::vector<Round>& rounds) {
  Round found = rounds.front();
  for (const Round& round : rounds) {
    found.alone = std::min(found.alone, round.alone);
    found.beside = std::min(found.beside, round.beside);
  }
  return found;
}

/// Of each round, since what is compared must have met the same neighbours.
template <class Value, class Base>
bool judge(const char* what, const std::vector<Round>& rounds, const Value& value, const Base& base,
           double bound) {
  const double ratio =
      median(rounds, [&](const Round& round) { return value(round) / base(round); });
  std::printf("%-52s %5.2f  (bound %.2f)%s\n", what, ratio, bound, ratio > bound ? "  BROKEN" : "");
  return ratio <= bound;
}

struct Bounds {
  double lines = 1.2;
  double websocket = 1.6;
  double robot_line = 1.2;
};

bool report(const std::vector<Round>& rounds, const Bounds& bounds) {
  const auto bare = [](const Round& round) { return round.bare; };
  const auto lines = [](const Round& round) { return round.lines; };
  const auto websocket = [](const Round& round) { return round.websocket; };
  const auto alone = [](const Round& round) { return round.alone; };
  const auto beside = [](const Round& round) { return round.beside; };
  std::printf("medians: bare write loop %.2f us a message, JSON lines %.2f, WebSocket %.2f\n",
              median(rounds, bare), median(rounds, lines), median(rounds, websocket));
  std::printf("robot line, p99 of a round trip: %.0f us alone, %.0f us beside the viewers\n",
              best(rounds).alone, best(rounds).beside);
  bool is_kept =
      judge("JSON lines against the bare loop, CPU a message", rounds, lines, bare, bounds.lines);
  is_kept = judge("WebSocket against the bare loop, CPU a message", rounds, websocket, bare,
                  bounds.websocket) &&
            is_kept;
  return judge("robot line's p99 beside the viewers against alone", {best(rounds)}, beside, alone,
               bounds.robot_line) &&
         is_kept;
}

bool run(const std::string& xr3, int viewers, int rounds, const Bounds& bounds) {
  const Child server([&] {
    ::execl(xr3.c_str(), "xr3", "serve", "--robot-port", "0", "--monitor-port", "0", "--log-level",
            "off", nullptr);
  });
  const std::string greeting = server.greeting();
  const int monitor = port_in(greeting, "monitor");
  const int robot = port_in(greeting, "robot");
  const std::string message = sample(monitor);
  std::printf("%d viewers at %d Hz, %zu bytes a message, %d rounds\n", viewers, kHz, message.size(),
              rounds);
  const Child loop([&] { write_loop(viewers, message); });
  const int bare_port = port_in(loop.greeting(), "bare");
  BareLoop bare(loop.pid(), many(viewers, [=] { return connect_to(bare_port); }), message.size());
  Server lines(server.pid(), monitor, viewers, Carrier::kLines, message.size());
  // A header of four bytes for a line end.
  Server websocket(server.pid(), monitor, viewers, Carrier::kWebsocket, message.size() + 3);
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
  bare.start();  // a stopped process would not end
  return report(found, bounds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("bench_fanout XR3 [VIEWERS [ROUNDS [BOUNDS...]]]\n", stderr), 2;
  const auto number = [&](int i, double otherwise) {
    return i < argc ? std::atof(argv[i]) : otherwise;
  };
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ::signal(SIGPIPE, SIG_IGN);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  stay_at(Place::kMeasures);
  try {
    const bool is_kept =
        run(argv[1], static_cast<int>(number(2, 1000)), static_cast<int>(number(3, 9)),
            {number(4, 1.2), number(5, 1.6), number(6, 1.2)});
    return is_kept ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_fanout: %s\n", error.what()), 2;
  }
}
