// Helpers for the benchmarks over sockets: child processes to be measured, connections, and
// statistics over several rounds. POSIX only; works with any server.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace xr3::bench {

/// Puts measuring process, server and reader on different processors if there are enough. Otherwise
/// a wake-up could put a client on the server's processor, and the scheduler's time slice would be
/// measured.
enum class Place { kMeasures = 0, kServes = 1, kReads = 2 };
void stay_at(Place place);

/// Raises the limit of descriptors to the maximum, ignores SIGPIPE, and makes standard output line
/// buffered.
void prepare();

/// User plus system time of a process, seconds.
double cpu_s(pid_t pid);

/// Sleeps.
void pass(double seconds);

/// A child process on the servers' processor; the destructor ends it.
class Child {
 public:
  explicit Child(const std::function<void()>& run);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();
  pid_t pid() const { return pid_; }
  /// The first line of its output.
  std::string greeting() const;

 private:
  pid_t pid_ = 0;
  int out_ = -1;
};

/// Starts `xr3 serve` on free ports, without a log, with more options.
Child serve(const std::string& xr3, const std::vector<std::string>& options = {});

/// Opens a listening socket on a free port of this machine and prints the port as `NAME=` on
/// standard output.
int listen_as(const std::string& name);

/// The port in `NAME=127.0.0.1:9600`. Throws std::runtime_error if there is none.
int port_in(const std::string& greeting, const std::string& name);

// Connections on this machine, with TCP_NODELAY. These functions throw std::runtime_error.
int connect_to(int port);
void send_all(int fd, const std::string& bytes);
/// Reads at most 64 KiB; empty at the end of the connection.
std::string read_some(int fd);
void set_no_delay(int fd);

double median(std::vector<double> values);

/// Prints a figure with its bound. Returns whether the bound is met.
bool judge(const char* what, double ratio, double bound);

}  // namespace xr3::bench
