// A program under test as a child process in a session of its own: its environment, limits and
// output, and its end.
#pragma once

#include <sys/types.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/exec/private_network.hpp"
#include "cli/exec/program_user.hpp"
#include "server/net/standard_input.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

struct ProgramSettings {
  std::vector<std::string> command;  ///< the program, found in PATH, and its arguments
  /// Additional variables of its environment. It also has those of this process, without the ones
  /// whose names begin with XR3_, which configure this process and may contain a token.
  std::vector<std::pair<std::string, std::string>> environment;
  /// Reduces the environment of this process to path, language and time zone.
  bool is_stranger = false;
  bool has_input = false;  ///< passes the standard input of this process on
  /// The network that the program enters; nullptr for that of this process.
  const PrivateNetwork* network = nullptr;
  std::optional<ProgramUser> user;  ///< nullopt for the user of this process
  /// Maximum number of processes and threads at a time, where they can be counted apart from others
  /// of the user: in a user namespace of its own. 0 for no limit.
  std::size_t max_tasks = 0;
};

/// The end of a program.
struct ProgramEnd {
  int code = 0;    ///< exit code; meaningless after a signal
  int signal = 0;  ///< the signal that ended it; 0 if there was none
  bool is_good() const { return code == 0 && signal == 0; }
};

/// `exit code 3`, or `signal 11 (Segmentation fault)`.
std::string to_text(const ProgramEnd& end);

class Program {
 public:
  /// Receives text that the program has written to a stream, STDOUT_FILENO or STDERR_FILENO.
  using Output = std::function<void(int stream, std::string_view text)>;

  /// Starts the program. Its standard streams are pipes: it holds no descriptor of this process.
  /// Throws std::system_error if it cannot be started: it is missing, or not executable.
  Program(asio::io_context& io, const ProgramSettings& settings, Output output);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  /// Kills the program's group if it still runs.
  ~Program();

  /// Calls `ended` once, when the program itself has ended; other processes of its group may still
  /// run.
  void on_end(std::function<void(const ProgramEnd&)> ended);
  bool has_ended() const { return end_.has_value(); }

  /// Sends a signal to every process of the program's group.
  void signal(int number) const;
  /// Whether a process of the program's group still runs.
  bool has_group() const;
  /// The child of this process, which is reaped here.
  ::pid_t pid() const { return pid_; }
  /// Whether that child is the keeper of the program.
  bool has_keeper() const { return has_keeper_; }
  /// Whether a process may still print, or printed output is unread.
  bool has_output() const { return output_.pipe.is_open() || error_.pipe.is_open(); }

 private:
  struct OutputPipe {
    int stream;
    asio::posix::stream_descriptor pipe;
    std::array<char, 16 * 1024> buffer;
  };
  void read(OutputPipe& from);
  void reap();
  asio::awaitable<void> copy_input();

  ::pid_t pid_;  ///< the program or its keeper
  bool has_keeper_ = false;
  Descriptor status_;
  asio::posix::stream_descriptor ended_;  ///< becomes readable when the program ends
  std::optional<StandardInput> from_;
  asio::posix::stream_descriptor input_;  ///< the program's input, copied from `from_`
  OutputPipe output_;
  OutputPipe error_;
  Output on_output_;
  std::function<void(const ProgramEnd&)> on_end_;
  std::optional<ProgramEnd> end_;
};

}  // namespace xr3
