#include "protocol/monitor/event.hpp"

#include <string>
#include <string_view>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/note_words.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {
namespace {

Json label_json(char label) { return std::string(1, label); }
Json yaw_json(Microdegrees yaw) { return rounded(degrees(yaw), kDegreeDecimals); }

/// The member `event`: the kind of event.
struct Namer {
  std::string_view operator()(const MoveTaken&) const { return "move"; }
  std::string_view operator()(const Reached&) const { return "reached"; }
  std::string_view operator()(const MotorBlocked&) const { return "blocked"; }
  std::string_view operator()(const Stalled&) const { return "stalled"; }
  std::string_view operator()(const SwitchChanged&) const { return "switch"; }
  std::string_view operator()(const Grasped&) const { return "grasped"; }
  std::string_view operator()(const Released&) const { return "released"; }
  std::string_view operator()(const Homed&) const { return "homed"; }
  std::string_view operator()(const OutputChanged&) const { return "io"; }
  std::string_view operator()(const InputChanged&) const { return "io"; }
  std::string_view operator()(const AuxiliaryChanged&) const { return "io"; }
  std::string_view operator()(const EnabledChanged&) const { return "enabled"; }
  std::string_view operator()(const Warning&) const { return "warning"; }

  std::string_view operator()(const EventBody& body) const { return std::visit(*this, body); }
  std::string_view operator()(const ProblemNote&) const { return "warning"; }
  std::string_view operator()(const SuppressedNote&) const { return "warning"; }
  std::string_view operator()(const LineOpenedNote&) const { return "line_open"; }
  std::string_view operator()(const LineClosedNote&) const { return "line_close"; }
  std::string_view operator()(const ClockNote&) const { return "clock"; }
  std::string_view operator()(const ModelNote&) const { return "model"; }
  std::string_view operator()(const EpochNote&) const { return "epoch"; }
};

/// Adds the members that are specific to the kind of event.
struct Extras {
  const CellEvent& event;
  Json& members;

  void operator()(const EventBody& body) const { std::visit(*this, body); }
  void operator()(const MoveTaken& e) const {
    members["joint"] = label_json(e.label);
    members["counts"] = e.counts;
    members["error"] = e.error;
  }
  void operator()(const Reached& e) const {
    members["joint"] = label_json(e.label);
    members["count"] = e.count;
  }
  void operator()(const MotorBlocked& e) const {
    members["joint"] = label_json(e.label);
    members["count"] = e.count;
    members["error"] = e.error;
    members["by"] = label_json(e.why == Blocked::kLimit ? e.by : e.label);
  }
  void operator()(const Stalled&) const {}
  void operator()(const SwitchChanged& e) const {
    members["joint"] = label_json(e.label);
    members["closed"] = e.closed;
    members["count"] = e.count;
  }
  void operator()(const Grasped& e) const { add_block(e.block, e.centroid_um, e.yaw_udeg); }
  void operator()(const Released& e) const { add_block(e.block, e.centroid_um, e.yaw_udeg); }
  void operator()(const Homed&) const { members["by"] = event.line ? "serial" : "call"; }
  void operator()(const OutputChanged& e) const { add_io("output", e.line, e.high); }
  void operator()(const InputChanged& e) const { add_io("input", e.line, e.high); }
  void operator()(const AuxiliaryChanged& e) const { add_io("aux", e.port, e.on); }
  void operator()(const EnabledChanged& e) const { members["enabled"] = e.enabled; }
  void operator()(const Warning&) const { add_warning(nullptr, nullptr, 1); }

  void operator()(const ProblemNote& note) const {
    add_warning(note.offset, hexadecimal(note.raw.view()), note.count);
  }
  void operator()(const SuppressedNote& note) const { add_warning(nullptr, nullptr, note.count); }
  void operator()(const LineOpenedNote& note) const {
    members["kind"] = name_of(note.kind);
    members["peer"] = note.peer;
  }
  void operator()(const LineClosedNote& note) const {
    members["bytes_in"] = note.bytes_in;
    members["bytes_out"] = note.bytes_out;
  }
  void operator()(const ClockNote& note) const {
    members["clock"] = clock_json(note.mode, note.rate);
  }
  void operator()(const ModelNote& note) const { members["model_rev"] = note.model_rev; }
  void operator()(const EpochNote& note) const {
    members["from_epoch"] = note.from_epoch;
    members["from_tick"] = note.from_tick;
  }

 private:
  void add_block(const std::string& name, const PointUm& centroid, Microdegrees yaw) const {
    members["block"] = name;
    members["xyz_mm"] = point_json(centroid);
    members["yaw_deg"] = yaw_json(yaw);
  }
  void add_io(const char* which, int number, bool value) const {
    members[which] = number;
    members["value"] = value;
  }
  void add_warning(Json offset, Json hex, int count) const {
    members["offset"] = std::move(offset);
    members["hex"] = std::move(hex);
    members["count"] = count;
  }
};

}  // namespace

Json event_json(const CellEvent& event, const Model& model) {
  Json members = {{"event", std::visit(Namer{}, event.note)},
                  {"line", event.line ? Json(*event.line) : Json(nullptr)},
                  {"code", code_of(event)},
                  {"message", describe(event, model)}};
  std::visit(Extras{event, members}, event.note);
  return members;
}

}  // namespace xr3
