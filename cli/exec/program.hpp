// A program under test as a child process in a group of its own: its environment, limits and
// output, and its end.
#pragma once

#include <sys/types.h>

#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/exec/private_network.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

struct ProgramSettings {
  std::vector<std::string> command;  ///< the program, found in PATH, and its arguments
  /// Variables of its environment. It has those of this process, too, without the ones whose names
  /// begin with XR3_: they were meant for this process, and may hold a token.
  std::vector<std::pair<std::string, std::string>> environment;
  bool is_stranger = false;  ///< of this process's environment it gets path, language and time zone
  bool has_terminal = false;  ///< it inherits standard input, and stays in the terminal's group
  bool is_captured = false;   ///< its standard output and error come to `output`
  const PrivateNetwork* network = nullptr;  ///< that it enters; null: that of this process
  std::size_t max_memory_mib = 0;           ///< of address space, for each process; 0: no limit
  std::size_t max_processes = 0;            ///< of its user; 0: no limit
};

/// How a program has ended.
struct ProgramEnd {
  int code = 0;    ///< its exit code; meaningless after a signal
  int signal = 0;  ///< the signal that ended it; 0: none
  bool is_good() const { return code == 0 && signal == 0; }
};

/// `exit code 3`, or `signal 11 (Segmentation fault)`.
std::string to_text(const ProgramEnd& end);

class Program {
 public:
  using Output = std::function<void(std::string_view)>;

  /// Starts the program. `output` is called with what it prints, if it is captured. Throws
  /// std::system_error if it cannot be started: it is missing, or not executable.
  Program(asio::io_context& io, const ProgramSettings& settings, Output output);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  /// Kills its group if it still runs.
  ~Program();

  /// Calls `ended` once, when the program itself has ended; others of its group may still run.
  void on_end(std::function<void(const ProgramEnd&)> ended);
  bool has_ended() const { return end_.has_value(); }

  /// Sends a signal to every process of its group.
  void signal(int number) const;
  /// Whether a process of its group still runs.
  bool has_group() const;
  ::pid_t pid() const { return pid_; }
  /// Whether a process may still print, or what was printed has yet to be read.
  bool has_output() const { return output_.is_open(); }

 private:
  void read();
  void reap();

  ::pid_t pid_;
  bool has_group_of_its_own_;
  asio::posix::stream_descriptor ended_;  ///< becomes readable when the program ends
  asio::posix::stream_descriptor output_;
  Output on_output_;
  std::function<void(const ProgramEnd&)> on_end_;
  std::optional<ProgramEnd> end_;
  std::array<char, 16 * 1024> buffer_{};
};

}  // namespace xr3
