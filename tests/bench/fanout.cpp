// What a viewer costs: a thousand of them at 60 Hz, by JSON lines and by WebSocket, against a bare loop of
// writes with the same bytes in the same run; and what they do to the round trip of a robot line beside
// them. It speaks POSIX only. Usage: bench_fanout XR3 [VIEWERS [SECONDS [LINES_BOUND WEBSOCKET_BOUND
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
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kHz = 60;
const std::string kRequest =
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
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream rest(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) rest >> skipped;
  long user = 0;
  long system = 0;
  rest >> user >> system;
  return static_cast<double>(user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
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

/// CPU time of a process for each message of so many bytes, in microseconds.
double us_a_message(pid_t pid, const Drain& drain, std::size_t message_bytes, double seconds) {
  const double cpu = cpu_s(pid);
  const std::uint64_t bytes = drain.bytes();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const double messages =
      static_cast<double>(drain.bytes() - bytes) / static_cast<double>(message_bytes);
  const double spent = cpu_s(pid) - cpu;
  std::printf("    %.0f messages a second, %.0f %% of a processor\n", messages / seconds,
              100 * spent / seconds);
  return spent * 1e6 / messages;
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
  for (auto next = Clock::now();; next += std::chrono::microseconds(1'000'000 / kHz)) {
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

int follow(int port, Carrier carrier) {
  const int fd = connect_to(port);
  if (carrier == Carrier::kWebsocket) {
    send_all(fd, kHandshake);
    if (read_some(fd).find(" 101 ") == std::string::npos) throw std::runtime_error("no WebSocket");
  }
  send_all(fd, carrier == Carrier::kLines ? kRequest + "\n" : masked_frame(kRequest));
  return fd;
}

std::vector<int> follow_all(int viewers, int port, Carrier carrier) {
  std::vector<int> fds;
  for (int i = 0; i < viewers; ++i) fds.push_back(follow(port, carrier));
  return fds;
}

/// What one viewer is sent again and again, with its line end.
std::string sample(int port) {
  const int fd = follow(port, Carrier::kLines);
  std::string all;
  while (std::count(all.begin(), all.end(), '\n') < 4) all += read_some(fd);
  ::close(fd);
  std::istringstream lines(all);
  std::string line;
  while (std::getline(lines, line) && line.find(R"("op":"state")") == std::string::npos) {
  }
  return line + "\n";
}

/// Round trips of an inquiry, microseconds: the best of the rounds' 99th percentiles.
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

bool judge(const char* what, double ratio, double bound) {
  std::printf("%-52s %5.2f  (bound %.2f)%s\n", what, ratio, bound, ratio > bound ? "  BROKEN" : "");
  return ratio <= bound;
}

struct Bounds {
  double lines = 1.2;
  double websocket = 1.6;
  double robot_line = 1.2;
};

int run(const std::string& xr3, int viewers, double seconds, const Bounds& bounds) {
  const Child server([&] {
    ::execl(xr3.c_str(), "xr3", "serve", "--robot-port", "0", "--monitor-port", "0", "--log-level",
            "off", nullptr);
  });
  const std::string greeting = server.greeting();
  const int monitor = port_in(greeting, "monitor");
  const int robot = port_in(greeting, "robot");
  const std::string message = sample(monitor);
  std::printf("%d viewers at %d Hz, %zu bytes a message\n", viewers, kHz, message.size());

  std::vector<double> bare;
  std::vector<double> lines;
  std::vector<double> websocket;
  std::vector<double> alone;
  std::vector<double> beside;
  for (int round = 0; round < 3; ++round) {
    {
      const Child loop([&] { write_loop(viewers, message); });
      const int port = port_in(loop.greeting(), "bare");
      std::vector<int> fds;
      for (int i = 0; i < viewers; ++i) fds.push_back(connect_to(port));
      const Drain drain(std::move(fds));
      std::this_thread::sleep_for(milliseconds(300));
      bare.push_back(us_a_message(loop.pid(), drain, message.size(), seconds));
    }
    alone.push_back(line_p99_us(robot, seconds));
    for (const Carrier carrier : {Carrier::kLines, Carrier::kWebsocket}) {
      const Drain drain(follow_all(viewers, monitor, carrier));
      std::this_thread::sleep_for(milliseconds(500));
      const bool is_lines = carrier == Carrier::kLines;
      const std::size_t size = message.size() + (is_lines ? 0 : 3);  // a header of 4 for a line end
      (is_lines ? lines : websocket).push_back(us_a_message(server.pid(), drain, size, seconds));
      if (is_lines) beside.push_back(line_p99_us(robot, seconds));
    }
    std::this_thread::sleep_for(milliseconds(300));
  }
  const auto best = [](const std::vector<double>& all) {
    return *std::min_element(all.begin(), all.end());
  };
  std::printf("bare write loop %.2f us a message, JSON lines %.2f, WebSocket %.2f\n", best(bare),
              best(lines), best(websocket));
  std::printf("robot line, p99 of a round trip: %.0f us alone, %.0f us beside the viewers\n",
              best(alone), best(beside));
  bool is_kept = judge("JSON lines against the bare loop, CPU a message", best(lines) / best(bare),
                       bounds.lines);
  is_kept = judge("WebSocket against the bare loop, CPU a message", best(websocket) / best(bare),
                  bounds.websocket) &&
            is_kept;
  is_kept = judge("robot line's p99 beside the viewers against alone", best(beside) / best(alone),
                  bounds.robot_line) &&
            is_kept;
  return is_kept ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("bench_fanout XR3 [VIEWERS [SECONDS [BOUNDS...]]]\n", stderr), 2;
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
    return run(argv[1], static_cast<int>(number(2, 1000)), number(3, 3),
               {number(4, 1.2), number(5, 1.6), number(6, 1.2)});
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_fanout: %s\n", error.what()), 2;
  }
}
