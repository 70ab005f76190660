#include "service/calls.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "cell/digest.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/monitor/saved_faults.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "service/answer.hpp"

namespace xr3::service {
namespace {

/// The error if a client's snapshot has a state that is impossible on this robot; else nullopt.
std::optional<monitor::RequestError> validate_snapshot(const monitor::RequestId& id,
                                                       const Model& model, const call::Call& call) {
  const auto* load = std::get_if<call::LoadSnapshot>(&call);
  if (load == nullptr || !load->saved || load->saved->robot_hash != robot_hash(model))
    return std::nullopt;
  auto details = monitor::validate(model, *load->saved);
  if (details.empty()) return std::nullopt;
  return monitor::RequestError{id, "bad_args", "the snapshot does not fit the robot",
                               "nothing was changed", std::move(details)};
}

Json value_with_faults(const Cell& cell) {
  Json value = value_now(cell);
  add_fault_list(cell.state(), value);
  return value;
}

/// The name under which a snapshot is saved or loaded; empty if it is inline.
std::string snapshot_name(const call::Call& call) {
  const auto* save = std::get_if<call::SaveSnapshot>(&call);
  return save != nullptr ? save->name : std::get<call::LoadSnapshot>(call).name;
}

void add_saved(const SavedCell& cell, const std::string& name, bool is_inline, Json& value) {
  const Json saved = saved_cell_to_json(cell);
  value["name"] = name.empty() ? Json() : Json(name);
  value["hash"] = sha256(saved.dump());
  if (is_inline) value["snapshot"] = saved;
}

Json marks_json(const TranscriptSummary& summary) {
  Json marks = Json::array();
  for (const TranscriptMark mark : summary.marks) marks.push_back(name_of(mark));
  return marks;
}

monitor::Message done(const CellCall& of, const call::Call& call, const call::Done& done) {
  const Cell& cell = of.cell;
  const call::Traits traits = call::traits_of(call);
  if (traits.returns_faults) return monitor::result(of.id(), value_with_faults(cell));
  Json value = value_now(cell);
  if (done.reached) value["reached"] = *done.reached;
  if (done.ran_ticks) value["ran_ticks"] = *done.ran_ticks;
  if (traits.moves_time)
    value["state"] = state_json(cell.model(), cell.snapshot(), of.wanted.fields);
  if (done.saved) {
    const std::string name = snapshot_name(call);
    const bool is_inline = name.empty() && std::holds_alternative<call::SaveSnapshot>(call);
    add_saved(*done.saved, name, is_inline, value);
  }
  return monitor::result(of.id(), value);
}

}  // namespace

monitor::Message carry_out(const CellCall& of, const call::Call& call) {
  Cell& cell = of.cell;
  if (const auto error = monitor::limit_ticks(of.request, cell.state().tick))
    return monitor::result(*error);
  if (const auto error = validate_snapshot(of.id(), cell.model(), call))
    return monitor::result(*error);
  const Applied applied = cell.apply(call, of.now);
  if (const auto* no = std::get_if<call::Refused>(&applied.outcome)) return refused(of.id(), *no);
  return done(of, call, std::get<call::Done>(applied.outcome));
}

monitor::Message carry_out(const CellCall& of, const monitor::ListFaults&) {
  return monitor::result(of.id(), value_with_faults(of.cell));
}

monitor::Message carry_out(const CellCall& of, const monitor::ReadTranscript&) {
  Cell& cell = of.cell;
  cell.catch_up(of.now);
  if (cell.transcript() == nullptr)
    return refused(of.id(), {"no_transcript", "only the byte clock has a transcript",
                             "start with --clock bytes"});
  const TranscriptSummary summary = cell.transcript()->summary();
  Json value = value_now(cell);
  value["sha256"] = transcript_digest(summary, cell.model(), cell.state(), cell.clock_remainder());
  value["lines"] = summary.lines;
  value["bytes_in"] = summary.bytes_in;
  value["bytes_out"] = summary.bytes_out;
  value["marks"] = marks_json(summary);
  return monitor::result(of.id(), value);
}

}  // namespace xr3::service
