#include "server/log.hpp"

#include <poll.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "protocol/explain/event_report.hpp"
#include "protocol/text/printable.hpp"
#include "server/log_budget.hpp"
#include "server/log_file.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// A parent process that never reads our standard error must not block the robot. A pipe that polls
// writable accepts PIPE_BUF bytes without blocking; longer messages are cut.
void write_to_standard_error(std::string_view text) {
  constexpr std::size_t kMaxBytes = 4096;
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0) return;
  const auto written = ::write(STDERR_FILENO, text.data(), std::min(text.size(), kMaxBytes));
  (void)written;  // an error cannot be reported anywhere
}

/// Writes what the budget admits, as one line each, and says how many messages it has dropped.
class LogSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit LogSink(const std::string& file) {
    set_pattern("%H:%M:%S.%e %l %v");
    if (!file.empty()) file_.emplace(file, kMaxLogFileBytes, kMaxLogFiles);
  }

  /// Whether an event may be logged now. If not, it counts as dropped. Events leave a reserve for
  /// the server's own messages: clients cause them.
  bool admit_event() { return budget_.admit(wall_now(), kReserve); }

 private:
  static constexpr std::size_t kReserve = std::size_t{16} * 1024;
  static constexpr std::size_t kPrefixBytes = 24;  // approximately: time and level

  void sink_it_(const spdlog::details::log_msg& message) override {
    const WallNs now = wall_now();
    if (message.level != spdlog::level::critical && !budget_.admit(now)) return;
    if (const std::uint64_t count = budget_.drain_dropped(now); count > 0)
      write(spdlog::level::warn, fmt::format("suppressed {} messages", count));
    write(message.level, printable_line({message.payload.data(), message.payload.size()}));
  }
  void flush_() override {}

  void write(spdlog::level::level_enum level, const std::string& line) {
    budget_.spend(kPrefixBytes + line.size());
    spdlog::memory_buf_t text;
    formatter_->format({"xr3", level, line}, text);
    const std::string_view formatted(text.data(), text.size());
    file_ ? file_->write(formatted) : write_to_standard_error(formatted);
  }

  std::optional<LogFile> file_;  ///< nullopt for standard error
  LogBudget budget_{wall_now()};
};

/// The sink of spdlog's default logger; null before start_log().
std::shared_ptr<LogSink> log_sink;

// Events of the machine are debug messages, except those that a user must see: stalls, faults,
// and warnings that no command caused. The end of a recording needs attention.
spdlog::level::level_enum level_of(const CellNote& note) {
  if (std::holds_alternative<RecordingNote>(note)) return spdlog::level::warn;
  const auto* continued = std::get_if<ContinuedNote>(&note);
  if (continued != nullptr && !continued->why.empty()) return spdlog::level::warn;
  const auto* body = std::get_if<EventBody>(&note);
  const bool matters = body == nullptr || std::holds_alternative<Stalled>(*body) ||
                       std::holds_alternative<Warning>(*body) ||
                       std::holds_alternative<FaultNews>(*body);
  return matters ? spdlog::level::info : spdlog::level::debug;
}

/// The prefix: line or cell, tick, and code. Events of lines, clock and model need no code: their
/// sentences suffice.
std::string before(const CellEvent& event, std::string_view code) {
  const std::string at = " @" + std::to_string(event.tick) + ": ";
  const bool is_named = !std::holds_alternative<EventBody>(event.note) &&
                        !std::holds_alternative<ProblemNote>(event.note) &&
                        !std::holds_alternative<SuppressedNote>(event.note) &&
                        !std::holds_alternative<HandoverNote>(event.note);
  if (is_named) return "cell" + at;
  const std::string where = event.line ? "line " + std::to_string(*event.line) : "cell";
  return where + at + std::string(code) + ": ";
}

/// The suffix: counts, offsets and the address that the sentence does not contain.
std::string behind(const CellNote& note, std::string_view page) {
  if (const auto* problem = std::get_if<ProblemNote>(&note)) {
    return fmt::format("; byte {}{}", problem->offset,
                       problem->count > 1 ? fmt::format(", {} in a row", problem->count) : "");
  }
  if (const auto* closed = std::get_if<LineClosedNote>(&note)) {
    const bool is_foreign = closed->reason == LineCloseReason::kNotARobotProgram;
    return fmt::format("; {} bytes in, {} out", closed->bytes_in, closed->bytes_out) +
           (is_foreign && !page.empty() ? "; " + browser_hint(page) : "");
  }
  return "";
}

}  // namespace

void start_log(const std::string& level, const std::string& file) {
  log_sink = std::make_shared<LogSink>(file);
  auto logger = std::make_shared<spdlog::logger>("xr3", log_sink);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_event(const CellEvent& event, const Model& model, const LogNames& names) {
  const auto level = level_of(event.note);
  if (!spdlog::should_log(level)) return;
  if (log_sink && !log_sink->admit_event()) return;  // before the text is made
  const EventReport about = report(event, model);
  const std::string of_cell = names.cell.empty() ? "" : fmt::format("cell {}: ", names.cell);
  spdlog::log(level, "{}{}{}{}", of_cell, before(event, about.code), about.message,
              behind(event.note, names.page));
}

std::string browser_hint(std::string_view page) {
  return "a browser belongs on the monitor port: " + std::string(page);
}

}  // namespace xr3
