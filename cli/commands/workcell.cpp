#include "protocol/files/workcell.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cli/commands/commands.hpp"
#include "core/inverse/empty_table.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"
#include "server/print.hpp"
#include "tools/workcell_editor/dialogue.hpp"

namespace xr3 {
namespace {

/// Reads standard input by lines, until its end or a signal to stop. At most one instance at a
/// time.
class KeyboardInput {
 public:
  enum class InputEnd : std::uint8_t { kNone, kOfInput, kSignal };

  KeyboardInput();
  ~KeyboardInput();
  KeyboardInput(const KeyboardInput&) = delete;
  KeyboardInput& operator=(const KeyboardInput&) = delete;

  /// The next line without its line end; nullopt after the last one.
  std::optional<std::string> line();
  InputEnd end() const { return end_; }
  bool is_terminal() const { return is_terminal_; }

 private:
  static constexpr std::size_t kMaxLength = 65536;  // longer input is split
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

  static void stop(int signal);
  void read_more();
  std::string take(std::size_t length, std::size_t line_end);

  static volatile std::sig_atomic_t stopped;
  static volatile std::sig_atomic_t nothing;  // a descriptor of /dev/null
  bool is_terminal_ = ::isatty(STDIN_FILENO) != 0;
  std::string text_;
  InputEnd end_ = InputEnd::kNone;
};

volatile std::sig_atomic_t KeyboardInput::stopped = 0;
volatile std::sig_atomic_t KeyboardInput::nothing = -1;

KeyboardInput::KeyboardInput() {
  stopped = 0;
  nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  struct sigaction action {};
  action.sa_handler = &KeyboardInput::stop;
  for (const int signal : kSignals) ::sigaction(signal, &action, nullptr);
}

KeyboardInput::~KeyboardInput() {
  for (const int signal : kSignals) std::signal(signal, SIG_DFL);
  ::close(nothing);
}

/// Signal handler. The signal interrupts a blocked read; a read that is just about to block gets
/// the end of /dev/null instead.
void KeyboardInput::stop(int signal) {
  const int before = errno;
  stopped = signal;
  ::dup2(nothing, STDIN_FILENO);
  errno = before;
}

void KeyboardInput::read_more() {
  char bytes[4096];
  const ::ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
  if (stopped != 0) {
    end_ = InputEnd::kSignal;
  } else if (count > 0) {
    text_.append(bytes, static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    end_ = InputEnd::kOfInput;
  }
}

std::string KeyboardInput::take(std::size_t length, std::size_t line_end) {
  std::string line = text_.substr(0, length);
  text_.erase(0, length + line_end);
  return line;
}

/// The next line. Text after the last line end of a pipe is a line, too.
std::optional<std::string> KeyboardInput::line() {
  while (end_ == InputEnd::kNone) {
    const std::size_t end = text_.find('\n');
    if (end != std::string::npos) return take(end, 1);
    if (text_.size() >= kMaxLength) return take(kMaxLength, 0);
    read_more();
  }
  if (end_ == InputEnd::kSignal || text_.empty() || is_terminal()) return std::nullopt;
  return take(text_.size(), 0);
}

/// The error for an unusable file: its findings, or that it is of another kind.
DataError unusable(const CheckResult& data, const std::string& file, const std::string& wanted) {
  if (!data.is_good()) return DataError(data.findings);
  return DataError({{Severity::kError, file, 1, 0, "", "a file of the other kind", wanted}});
}

/// The robot of --robot; else the one with the file's name; else the Rhino.
Robot robot_for(const WorkcellOptions& options) {
  std::string name = options.robot;
  if (name.empty()) name = std::filesystem::path(options.file).stem();
  if (options.robot.empty() && !has_data_file(name, "robots")) name = kUsualRobot;
  const DataFile data = find_data_file(name, "robots");
  CheckResult result = check_either_form(data.text, data.path, Profile::kPaper);
  if (!result.robot) throw unusable(result, data.path, "a robot");
  return *std::move(result.robot);
}

Workcell workcell_in(const DataFile& data) {
  CheckResult result = check_either_form(data.text, data.path, Profile::kPaper);
  if (!result.workcell) throw unusable(result, data.path, "a workcell");
  return *std::move(result.workcell);
}

/// Checks the target at the start, so that no work is lost when saving.
void check_target(const std::filesystem::path& file) {
  if (file.extension() != ".json") {
    throw FileError(file.string() + ": a workcell is written as JSON; its name must end in .json");
  }
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (::access(folder.c_str(), W_OK) != 0) {
    throw FileError(file.string() + ": cannot be written: " + folder.string() + ": " +
                    std::strerror(errno));
  }
}

/// The start of the dialogue: from --from, else from the file itself if it exists, else from
/// nothing.
DialogueStart start_of(const WorkcellOptions& options) {
  check_target(options.file);
  DialogueStart start{options.file, std::nullopt, "", robot_for(options)};
  std::error_code error;
  if (!options.from.empty()) {
    start.from = options.from;
    start.workcell = options.from == kNoWorkcell
                         ? empty_table(Reach(start.robot))
                         : workcell_in(find_data_file(options.from, "workcells"));
  } else if (std::filesystem::exists(options.file, error)) {
    start.from = options.file;
    start.workcell = workcell_in(read_file(options.file));
  }
  return start;
}

DialogueTurn write(const WorkcellOptions& options, const DialogueTurn& turn,
                   WorkcellDialogue& dialogue) {
  const std::string text = turn.file_text.value_or("");
  const Existing existing = turn.may_replace ? Existing::kReplace : Existing::kKeep;
  try {
    const bool is_written =
        write_file_atomically(options.file, text, existing,
                              [](const DataFile& draft) { load_workcell(draft.text, draft.path); });
    return dialogue.written(is_written ? WriteOutcome::kWritten : WriteOutcome::kIsThere);
  } catch (const std::runtime_error& error) {  // FileError, DataError
    return dialogue.written(WriteOutcome::kFailed, error.what());
  }
}

/// Passes a line to the dialogue. Piped input is echoed as if it were typed.
DialogueTurn handle_line(KeyboardInput& input, WorkcellDialogue& dialogue) {
  const std::optional<std::string> line = input.line();
  if (!line) {
    print_text("\n");
    return dialogue.leave(input.end() == KeyboardInput::InputEnd::kSignal ? "Interrupted"
                                                                          : "End of input");
  }
  if (!input.is_terminal()) print_text(*line + "\n");
  return dialogue.handle(*line);
}

}  // namespace

ExitCode run_command(const WorkcellOptions& options) {
  WorkcellDialogue dialogue(start_of(options));
  KeyboardInput input;
  DialogueTurn turn = dialogue.begin();
  print_text(turn.text);
  while (!turn.is_over) {
    turn = turn.file_text ? write(options, turn, dialogue) : handle_line(input, dialogue);
    print_text(turn.text);
  }
  const bool is_lost = input.end() != KeyboardInput::InputEnd::kNone && dialogue.has_unsaved();
  return is_lost ? ExitCode::kBadInput : ExitCode::kGood;
}

}  // namespace xr3
