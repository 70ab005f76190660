#include "server/log.hpp"

#include <poll.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>

#include "protocol/diagnostic.hpp"

namespace xr3 {
namespace {

// A parent that starts xr3 with a pipe and never reads it must not stop the robot. A pipe that polls
// writable takes PIPE_BUF bytes at once; what is longer is cut to that.
class PatientSink : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
  static constexpr std::size_t kMostBytes = 4096;

  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0) return;
    const auto written = ::write(STDERR_FILENO, text.data(), std::min(text.size(), kMostBytes));
    (void)written;  // nobody is left to be told
  }
  void flush_() override {}
};

std::string_view words(CloseReason reason) {
  switch (reason) {
    case CloseReason::kClientClosed: return "closed by its client";
    case CloseReason::kStranger:
      return "closed: it spoke HTTP or TLS, and not one byte of it has acted";
    case CloseReason::kError: return "lost";
    case CloseReason::kShutdown: return "closed: the server stops";
    case CloseReason::kDisconnected: return "closed: a monitor disconnected it";
  }
  return "";
}

struct NoteLogger {
  const CellEvent& event;
  const Model& model;

  std::string where() const {
    return (event.line ? "line " + std::to_string(*event.line) : "cell") + " @" +
           std::to_string(event.tick);
  }
  // What a student has to know even if nothing was asked: a stall, and warnings that come with time.
  void operator()(const EventBody& body) const {
    const bool matters =
        std::holds_alternative<Stalled>(body) || std::holds_alternative<Warning>(body);
    const auto level = matters ? spdlog::level::info : spdlog::level::debug;
    if (!spdlog::should_log(level)) return;
    spdlog::log(level, "{}: {}: {}", where(), code_of(body), describe(body, model));
  }
  void operator()(const ProblemNote& note) const {
    spdlog::info("{}: {}: byte {}: {}{}", where(), note.code, note.offset, note.message,
                 note.count > 1 ? " (" + std::to_string(note.count) + " in a row)" : "");
  }
  void operator()(const SuppressedNote& note) const {
    spdlog::info("{}: suppressed: {} more warnings in that second", where(), note.count);
  }
  void operator()(const LineOpenedNote& note) const {
    spdlog::info("{}: opened by {}", where(), note.peer);
  }
  void operator()(const LineClosedNote& note) const {
    spdlog::info("{}: {}; {} bytes in, {} out", where(), words(note.reason), note.bytes_in,
                 note.bytes_out);
  }
  void operator()(const ClockNote& note) const {
    spdlog::info("{}: clock: {}", where(), note.call);
  }
  void operator()(const ModelNote& note) const {
    spdlog::info("{}: workcell changed: {} {}", where(), note.call, note.name);
  }
  void operator()(const EpochNote& note) const {
    spdlog::info("{}: reset: tick {} of epoch {} became tick 0", where(), note.from_tick,
                 note.from_epoch);
  }
};

}  // namespace

void start_log(const std::string& level) {
  auto logger = std::make_shared<spdlog::logger>("xr3", std::make_shared<PatientSink>());
  logger->set_pattern("%H:%M:%S.%e %l %v");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

void log_event(const CellEvent& event, const Model& model) {
  std::visit(NoteLogger{event, model}, event.note);
}

}  // namespace xr3
