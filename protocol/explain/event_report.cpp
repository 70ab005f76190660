#include "protocol/explain/event_report.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/fault_text.hpp"
#include "protocol/json/values.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

const char* unit_of(const Model& model, char label) {
  return model.is_length(model.index_of(label)) ? "mm" : "deg";
}

Json::object_t io_members(const char* which, int number, bool value) {
  return {{which, number}, {"value", value}};
}

Json::object_t block_members(const std::string& name, const PointUm& centroid, Microdegrees yaw) {
  return {{"block", name},
          {"xyz_mm", point_json(centroid)},
          {"yaw_deg", rounded(degrees(yaw), kDegreeDecimals)}};
}

Json::object_t warning_members(Json offset, Json hex, int count) {
  return {{"offset", std::move(offset)}, {"hex", std::move(hex)}, {"count", count}};
}

std::string text_of(const MotorBlocked& e, const Model& model) {
  const std::string left = ", " + std::to_string(std::abs(e.error)) + " counts short";
  if (e.why == Blocked::kBlock) return "the jaws are closed on a block" + left;
  const std::string limit = std::string(e.upper ? "upper" : "lower") + " limit of " +
                            significant_digits(e.limit, 6) + " " + unit_of(model, e.by);
  if (e.by == e.label) return letter_text(e.label) + " is at its " + limit + left;
  return letter_text(e.label) + " is blocked because it would move " + e.by + " past its " + limit +
         left;
}

std::string_view reason_text(LineCloseReason reason) {
  switch (reason) {
    case LineCloseReason::kClientClosed: return "closed by its client";
    case LineCloseReason::kNotARobotProgram:
      return "closed: its client sent HTTP, TLS, STUN or other bytes with which no robot program "
             "begins; none of its bytes were executed";
    case LineCloseReason::kError: return "lost";
    case LineCloseReason::kShutdown: return "closed: the server stops";
    case LineCloseReason::kDisconnected: return "closed by the monitor's line_disconnect";
    case LineCloseReason::kFault: return "closed by a fault on demand";
    case LineCloseReason::kMemory:
      return "closed: the server needs more memory than --max-memory, and this client has the most "
             "unread replies";
  }
  return "";
}

std::string rate_text(Rate rate) {
  return significant_digits(static_cast<double>(rate.millionths) / 1e6, 9) + " times real time";
}

/// The table of the machine's events.
struct MachineEvents {
  const Model& model;

  EventReport operator()(const MoveTaken& e) const {
    return {"move",
            "move",
            letter_text(e.label) + " " + signed_number(e.counts) + ": counter " +
                std::to_string(e.error),
            {{"joint", letter_text(e.label)}, {"counts", e.counts}, {"error", e.error}}};
  }
  EventReport operator()(const Reached& e) const {
    return {"reached",
            "reached",
            letter_text(e.label) + " has reached its target",
            {{"joint", letter_text(e.label)}, {"count", e.count}}};
  }
  EventReport operator()(const MotorBlocked& e) const {
    const bool at_limit = e.why == Blocked::kLimit;
    return {"blocked",
            at_limit ? "limit" : "block",
            text_of(e, model),
            {{"joint", letter_text(e.label)},
             {"count", e.count},
             {"error", e.error},
             {"by", letter_text(at_limit ? e.by : e.label)}}};
  }
  EventReport operator()(const Stalled& e) const {
    const bool by_region = e.why == Stall::kProtectedRegion;
    return {"stalled",
            by_region ? "protected_region" : "work_surface",
            std::string(by_region ? "the tool would enter the protected region"
                                  : "the tool would pass under the work surface") +
                "; A$ or reset clears the stall",
            {}};
  }
  EventReport operator()(const SwitchChanged& e) const {
    return {"switch",
            "switch",
            "the microswitch of " + letter_text(e.label) + (e.closed ? " closed" : " opened"),
            {{"joint", letter_text(e.label)}, {"closed", e.closed}, {"count", e.count}}};
  }
  EventReport operator()(const Grasped& e) const {
    return {"grasped", "grasped", "the jaws hold block " + e.block,
            block_members(e.block, e.centroid_um, e.yaw_udeg)};
  }
  EventReport operator()(const Released& e) const {
    return {"released", "released", "block " + e.block + " released",
            block_members(e.block, e.centroid_um, e.yaw_udeg)};
  }
  EventReport operator()(const Homed&) const { return {"homed", "homed", "soft home", {}}; }
  EventReport operator()(const OutputChanged& e) const {
    return {"io", "io", "output " + std::to_string(e.line) + (e.high ? " is high" : " is low"),
            io_members("output", e.line, e.high)};
  }
  EventReport operator()(const InputChanged& e) const {
    return {"io", "io", "input " + std::to_string(e.line) + (e.high ? " is high" : " is low"),
            io_members("input", e.line, e.high)};
  }
  EventReport operator()(const AuxiliaryChanged& e) const {
    return {"io", "io", "auxiliary port " + std::to_string(e.port) + (e.on ? " is on" : " is off"),
            io_members("aux", e.port, e.on)};
  }
  EventReport operator()(const EnabledChanged& e) const {
    return {
        "enabled",
        e.enabled ? "enabled" : "disabled",
        e.enabled ? "the simulator is enabled" : "the simulator is disabled; only A@ is executed",
        {{"enabled", e.enabled}}};
  }
  EventReport operator()(const FaultNews& e) const {
    return {"fault",
            code_of(e.kind),
            xr3::text_of(e),
            {{"fault", e.fault},
             {"phase", code_of(e.phase)},
             {"effects", e.effects},
             {"joint", e.label != 0 ? Json(letter_text(e.label)) : Json(nullptr)}}};
  }
  EventReport operator()(const Warning& e) const {
    return {"warning", code_of(e.code), text_of(e, model), warning_members(nullptr, nullptr, 1)};
  }
};

/// The table of the other events of a cell.
struct CellEvents {
  const CellEvent& event;
  const Model& model;

  std::string line() const { return event.line ? "line " + std::to_string(*event.line) : "a line"; }

  EventReport operator()(const EventBody& body) const {
    EventReport of_machine = report(body, model);
    if (std::holds_alternative<Homed>(body)) {
      of_machine.message += event.line ? " by A$" : " by a call";
      of_machine.members["by"] = event.line ? "serial" : "call";
    }
    return of_machine;
  }
  EventReport operator()(const ProblemNote& note) const {
    return {"warning", note.code, note.message,
            warning_members(note.offset, hexadecimal(note.raw.view()), note.count)};
  }
  EventReport operator()(const SuppressedNote& note) const {
    return {"warning", "suppressed",
            std::to_string(note.count) + " more warnings of this line in that simulated second",
            warning_members(nullptr, nullptr, note.count)};
  }
  EventReport operator()(const LineOpenedNote& note) const {
    return {"line_open",
            "line_open",
            line() + " opened by " + note.peer,
            {{"kind", name_of(note.kind)}, {"peer", note.peer}}};
  }
  EventReport operator()(const LineClosedNote& note) const {
    return {"line_close",
            code_of(note.reason),
            line() + " " + std::string(reason_text(note.reason)),
            {{"bytes_in", note.bytes_in}, {"bytes_out", note.bytes_out}}};
  }
  EventReport operator()(const LineTurnNote& note) const {
    const bool waits = note.waits_for != 0;
    return {"line_turn",
            waits ? "line_waits" : "line_turn",
            waits ? waits_text(note.waits_for) : "the turn of " + line() + " begins",
            {{"waits_for", waits ? Json(note.waits_for) : Json(nullptr)}}};
  }
  EventReport operator()(const ContestedNote& note) const {
    return {"contested",
            "contested",
            line() + " moves " + note.label + " while it has counts to go from a move of line " +
                std::to_string(note.other) +
                ": two programs move one joint, and the counts of both add up",
            {{"joint", letter_text(note.label)}, {"other_line", note.other}}};
  }
  EventReport operator()(const ClockNote& note) const {
    return {"clock", note.call, text_of(note), {{"clock", clock_json(note.mode, note.rate)}}};
  }
  EventReport operator()(const ModelNote& note) const {
    return {"model",
            note.call,
            "workcell changed: " + std::string(note.call) + " " + note.name,
            {{"model_rev", note.model_rev}}};
  }
  EventReport operator()(const EpochNote& note) const {
    return {"epoch",
            note.call,
            std::string(note.call) + ": tick " + std::to_string(note.from_tick) + " of epoch " +
                std::to_string(note.from_epoch) + " became tick " + std::to_string(event.tick) +
                " of epoch " + std::to_string(event.epoch),
            {{"from_epoch", note.from_epoch}, {"from_tick", note.from_tick}}};
  }
  EventReport operator()(const CellOpenedNote& note) const {
    return {"cell_opened", "cell_opened", "cell " + note.cell + " opened", {}};
  }
  EventReport operator()(const CellClosedNote& note) const {
    return {"cell_closed", "cell_closed", "cell " + note.cell + " closed", {}};
  }
  EventReport operator()(const HandoverNote& note) const {
    EventReport of_machine = report(EnabledChanged{note.enabled}, model);
    of_machine.message = text_of(note);
    return of_machine;
  }
  EventReport operator()(const DeviceNote& note) const {
    auto [code, message] = device_text(note);
    return {"device",
            code,
            std::move(message),
            {{"device", note.path}, {"hex", hexadecimal(note.raw.view())}, {"count", note.count}}};
  }
  EventReport operator()(const NoticeNote& note) const {
    return {"notice", "notice", note.text, {}};
  }
  EventReport operator()(const RecordingNote& note) const {
    return {"recording",
            "recording_failed",
            "the recording has ended, and the robot goes on: " + note.why,
            {{"file", note.path}}};
  }
  EventReport operator()(const ContinuedNote& note) const {
    const bool is_good = note.why.empty();
    return {"recording",
            is_good ? "continued" : "not_continued",
            is_good ? "the robot goes on from the end of " + note.path
                    : "the robot is at its beginning, since its recording cannot be repeated: " +
                          note.why,
            {{"file", note.path}}};
  }

 private:
  struct DeviceText {
    std::string_view code;
    std::string message;
  };
  static DeviceText device_text(const DeviceNote& note) {
    const std::string device = "device " + note.path;
    switch (note.news) {
      case DeviceNews::kOpened: return {"device_opened", device + " is there"};
      case DeviceNews::kLost:
        return {"device_lost", device + " is lost: " + note.why + "; commands for it are dropped"};
      case DeviceNews::kUnasked:
        return {"device_unasked", device + " has sent " + std::to_string(note.count) +
                                      " bytes that nobody asked for"};
      case DeviceNews::kStopped:
        return {"device_stopped", "all joints of " + device + " are stopped"};
      case DeviceNews::kMirrorDifference:
        return {"mirror_difference", device + " differs from the simulation: " + note.why};
      case DeviceNews::kMirrorLost:
        return {"mirror_lost", "the simulation stopped where " + device +
                                   " goes on; put the arm to the soft home and call mirror_align"};
      case DeviceNews::kMirrorAligned:
        return {"mirror_aligned",
                "the simulation is at the soft home, as " + device + " should be"};
    }
    return {};
  }
  static std::string text_of(const HandoverNote& note) {
    if (note.enabled) return "the simulator is enabled; device " + note.device + " gets no command";
    const std::string text = "the simulator is disabled; commands go to device " + note.device;
    if (!note.is_open) return text + ", which is not there: they are dropped";
    return note.is_mirrored ? text + ", and the simulation carries them out, too" : text;
  }
  std::string waits_text(LineId before) const {
    const std::string first = "line " + std::to_string(before);
    return line() + " waits, unread, until " + first + " is closed: the byte clock obeys one line" +
           " at a time; line_disconnect closes " + first + ", --concurrent-lines obeys all";
  }
  static std::string text_of(const ClockNote& note) {
    const std::string by = " (" + std::string(note.call) + ")";
    if (note.mode == ClockMode::kBytes) return "time moves with the bytes of the lines" + by;
    if (note.mode == ClockMode::kReal) return "time runs at " + rate_text(note.rate) + by;
    if (note.call != "rate") return "time is paused" + by;
    return "time is paused; it will run at " + rate_text(note.rate) + by;
  }
};

}  // namespace

std::string_view name_of(LineKind kind) {
  constexpr std::array<std::string_view, 6> kNames = {"tcp", "telnet", "rfc2217",
                                                      "pty", "device", "monitor"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view code_of(LineCloseReason reason) {
  constexpr std::array<std::string_view, kLineCloseReasons> kCodes = {
      "client_closed", "stranger", "error", "shutdown", "disconnected", "memory", "fault"};
  return kCodes.at(static_cast<std::size_t>(reason));
}

EventReport report(const EventBody& event, const Model& model) {
  return std::visit(MachineEvents{model}, event);
}

EventReport report(const CellEvent& event, const Model& model) {
  return std::visit(CellEvents{event, model}, event.note);
}

}  // namespace xr3
