#include "server/log.hpp"

#include <poll.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>

#include "protocol/explain/note_words.hpp"

namespace xr3 {
namespace {

/// Escapes control characters (C0, DEL and C1): names chosen by clients may contain any character.
std::string one_line(std::string_view formatted) {
  std::string line;
  for (const char c : formatted.substr(0, formatted.size() - 1)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_second_of_c1 = byte >= 0x80 && byte < 0xA0 && line.ends_with('\xC2');
    const bool is_control = byte < ' ' || byte == 0x7F;
    if (is_second_of_c1) line.pop_back();
    if (is_control || is_second_of_c1) {
      line += fmt::format("\\x{:02x}", byte);
    } else {
      line += c;
    }
  }
  return line + '\n';
}

// A parent process that never reads our standard error must not block the robot. A pipe that polls
// writable accepts PIPE_BUF bytes without blocking; longer messages are cut.
class PatientSink : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
  static constexpr std::size_t kMaxBytes = 4096;

  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t formatted;
    formatter_->format(message, formatted);
    const std::string text = one_line({formatted.data(), formatted.size()});
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0) return;
    const auto written = ::write(STDERR_FILENO, text.data(), std::min(text.size(), kMaxBytes));
    (void)written;  // an error cannot be reported anywhere
  }
  void flush_() override {}
};

// Events of the machine are debug messages, except those that a user must see: stalls, and warnings
// that no command caused.
spdlog::level::level_enum level_of(const CellNote& note) {
  const auto* body = std::get_if<EventBody>(&note);
  const bool matters = body == nullptr || std::holds_alternative<Stalled>(*body) ||
                       std::holds_alternative<Warning>(*body);
  return matters ? spdlog::level::info : spdlog::level::debug;
}

/// The prefix: line or cell, tick, and code. Events of lines, clock and model need no code: their
/// sentences suffice.
std::string before(const CellEvent& event) {
  const std::string at = " @" + std::to_string(event.tick) + ": ";
  const bool is_named = !std::holds_alternative<EventBody>(event.note) &&
                        !std::holds_alternative<ProblemNote>(event.note) &&
                        !std::holds_alternative<SuppressedNote>(event.note);
  if (is_named) return "cell" + at;
  const std::string where = event.line ? "line " + std::to_string(*event.line) : "cell";
  return where + at + std::string(code_of(event)) + ": ";
}

/// The suffix: counts and offsets that the sentence does not contain.
std::string behind(const CellNote& note) {
  if (const auto* problem = std::get_if<ProblemNote>(&note)) {
    return fmt::format("; byte {}{}", problem->offset,
                       problem->count > 1 ? fmt::format(", {} in a row", problem->count) : "");
  }
  if (const auto* closed = std::get_if<LineClosedNote>(&note)) {
    return fmt::format("; {} bytes in, {} out", closed->bytes_in, closed->bytes_out);
  }
  return "";
}

}  // namespace

void start_log(const std::string& level) {
  auto logger = std::make_shared<spdlog::logger>("xr3", std::make_shared<PatientSink>());
  logger->set_pattern("%H:%M:%S.%e %l %v");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

void log_event(const CellEvent& event, const Model& model) {
  const auto level = level_of(event.note);
  if (!spdlog::should_log(level)) return;
  spdlog::log(level, "{}{}{}", before(event), describe(event, model), behind(event.note));
}

}  // namespace xr3
