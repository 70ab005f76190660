// What the benchmarks over sockets share: processes that are measured from outside, connections, and
// figures of several rounds. POSIX only; what it measures may be any server.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace xr3::bench {

/// Keeps who measures, who is measured and who reads apart, where there are processors enough: a wake-up
/// would otherwise put a client where the server is busy, and the scheduler's slice would be measured.
enum class Place { kMeasures = 0, kServes = 1, kReads = 2 };
void stay_at(Place place);

/// As many descriptors as the system allows, no signal for a connection that is gone, lines written at once.
void prepare();

/// User and system time of a process, seconds.
double cpu_s(pid_t pid);

/// Lets so much time pass.
void pass(double seconds);

/// A child process, kept where servers are, that is ended with this value.
class Child {
 public:
  explicit Child(const std::function<void()>& run);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();
  pid_t pid() const { return pid_; }
  /// Its first line.
  std::string greeting() const;

 private:
  pid_t pid_ = 0;
  int out_ = -1;
};

/// An `xr3 serve` on free ports, without a log.
Child serve(const std::string& xr3);

/// A listening socket on a free port of this machine, which is told on standard output as `NAME=`.
int listen_as(const std::string& name);

/// The port in `NAME=127.0.0.1:9600`. Throws std::runtime_error.
int port_in(const std::string& greeting, const std::string& name);

// Connections on this machine, without delay. They throw std::runtime_error.
int connect_to(int port);
void send_all(int fd, const std::string& bytes);
/// What there is, at most 64 KiB; empty at the end.
std::string read_some(int fd);
void set_no_delay(int fd);

double median(std::vector<double> values);

/// Prints a ratio beside its bound; whether it is kept.
bool judge(const char* what, double ratio, double bound);

}  // namespace xr3::bench
