#include "protocol/explain/note_words.hpp"

#include <array>
#include <cstdio>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

std::string_view code_of_reason(LineCloseReason reason) {
  switch (reason) {
    case LineCloseReason::kClientClosed: return "client_closed";
    case LineCloseReason::kNotARobotProgram: return "stranger";
    case LineCloseReason::kError: return "error";
    case LineCloseReason::kShutdown: return "shutdown";
    case LineCloseReason::kDisconnected: return "disconnected";
  }
  return "";
}

std::string_view words(LineCloseReason reason) {
  switch (reason) {
    case LineCloseReason::kClientClosed: return "closed by its client";
    case LineCloseReason::kNotARobotProgram:
      return "closed: its client sent HTTP, TLS or STUN; none of its bytes were executed";
    case LineCloseReason::kError: return "lost";
    case LineCloseReason::kShutdown: return "closed: the server stops";
    case LineCloseReason::kDisconnected: return "closed by the monitor's line_disconnect";
  }
  return "";
}

std::string words(Rate rate) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(rate.millionths) / 1e6);
  return text.data() + std::string(" times real time");
}

struct Coder {
  std::string_view operator()(const EventBody& body) const { return xr3::code_of(body); }
  std::string_view operator()(const ProblemNote& note) const { return note.code; }
  std::string_view operator()(const SuppressedNote&) const { return "suppressed"; }
  std::string_view operator()(const LineOpenedNote&) const { return "line_open"; }
  std::string_view operator()(const LineClosedNote& note) const {
    return code_of_reason(note.reason);
  }
  std::string_view operator()(const ClockNote& note) const { return note.call; }
  std::string_view operator()(const ModelNote& note) const { return note.call; }
  std::string_view operator()(const EpochNote& note) const { return note.call; }
};

struct NoteDescriber {
  const CellEvent& event;
  const Model& model;

  std::string line() const { return event.line ? "line " + std::to_string(*event.line) : "a line"; }

  std::string operator()(const EventBody& body) const {
    std::string sentence = xr3::describe(body, model);
    if (std::holds_alternative<Homed>(body)) sentence += event.line ? " by A$" : " by a call";
    return sentence;
  }
  std::string operator()(const ProblemNote& note) const { return note.message; }
  std::string operator()(const SuppressedNote& note) const {
    return std::to_string(note.count) + " more warnings of this line in that simulated second";
  }
  std::string operator()(const LineOpenedNote& note) const {
    return line() + " opened by " + note.peer;
  }
  std::string operator()(const LineClosedNote& note) const {
    return line() + " " + std::string(words(note.reason));
  }
  std::string operator()(const ClockNote& note) const {
    const std::string by = " (" + std::string(note.call) + ")";
    if (note.mode == ClockMode::kReal) return "time runs at " + words(note.rate) + by;
    if (note.call != "rate") return "time is paused" + by;
    return "time is paused; it will run at " + words(note.rate) + by;
  }
  std::string operator()(const ModelNote& note) const {
    return "workcell changed: " + std::string(note.call) + " " + note.name;
  }
  std::string operator()(const EpochNote& note) const {
    return std::string(note.call) + ": tick " + std::to_string(note.from_tick) + " of epoch " +
           std::to_string(note.from_epoch) + " became tick " + std::to_string(event.tick) +
           " of epoch " + std::to_string(event.epoch);
  }
};

}  // namespace

std::string_view name_of(LineKind kind) {
  switch (kind) {
    case LineKind::kRaw: return "raw";
    case LineKind::kTelnet: return "telnet";
    case LineKind::kMonitor: return "monitor";
  }
  return "";
}

std::string_view code_of(const CellEvent& event) { return std::visit(Coder{}, event.note); }

std::string describe(const CellEvent& event, const Model& model) {
  return std::visit(NoteDescriber{event, model}, event.note);
}

}  // namespace xr3
