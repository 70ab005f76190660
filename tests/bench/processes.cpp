#include "tests/bench/processes.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <thread>

namespace xr3::bench {

void stay_at(Place place) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  if (processors < 3) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<int>(place), &set);
  ::sched_setaffinity(0, sizeof set, &set);
}

void prepare() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ::signal(SIGPIPE, SIG_IGN);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  stay_at(Place::kMeasures);
}

double cpu_s(pid_t pid) {
  clockid_t clock = 0;
  timespec spent{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &spent) != 0)
    throw std::runtime_error("no processor time of a child");
  return static_cast<double>(spent.tv_sec) + static_cast<double>(spent.tv_nsec) * 1e-9;
}

void pass(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

Child::Child(const std::function<void()>& run) {
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

Child::~Child() {
  ::kill(pid_, SIGTERM);
  ::kill(pid_, SIGCONT);  // a stopped process would not end
  ::waitpid(pid_, nullptr, 0);
  ::close(out_);
}

std::string Child::greeting() const {
  std::string line;
  for (char c = 0; ::read(out_, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

Child serve(const std::string& xr3, const std::vector<std::string>& options) {
  std::vector<std::string> words{"xr3", "serve",       "--robot-port", "0", "--monitor-port",
                                 "0",   "--log-level", "off"};
  words.insert(words.end(), options.begin(), options.end());
  return Child([&] {
    std::vector<char*> texts;
    for (std::string& each : words) texts.push_back(each.data());
    texts.push_back(nullptr);
    ::execv(xr3.c_str(), texts.data());
  });
}

int listen_as(const std::string& name) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(listener, reinterpret_cast<sockaddr*>(&address), size);
  ::listen(listener, 4096);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  std::printf("LISTENING %s=127.0.0.1:%d\n", name.c_str(), ntohs(address.sin_port));
  std::fflush(stdout);
  return listener;
}

int port_in(const std::string& greeting, const std::string& name) {
  const std::size_t at = greeting.find(name + "=");
  if (at == std::string::npos) throw std::runtime_error("not started: " + greeting);
  return std::atoi(greeting.c_str() + greeting.find(':', at) + 1);
}

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot connect");
  set_no_delay(fd);
  return fd;
}

void send_all(int fd, const std::string& bytes) {
  if (::send(fd, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("cannot send");
}

std::string read_some(int fd) {
  std::string bytes(65536, '\0');
  const ssize_t got = ::read(fd, bytes.data(), bytes.size());
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

void set_no_delay(int fd) {
  const int on = 1;
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

bool judge(const char* what, double ratio, double bound) {
  std::printf("%-52s %5.2f  (bound %.2f)%s\n", what, ratio, bound, ratio > bound ? "  BROKEN" : "");
  return ratio <= bound;
}

}  // namespace xr3::bench
