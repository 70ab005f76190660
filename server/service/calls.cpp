#include "server/service/calls.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/digest.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/monitor/saved_faults.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

bool moves_time(const monitor::CallRequest& wanted) {
  const auto* call = std::get_if<call::Call>(&wanted.call);
  return call != nullptr && call::traits_of(*call).moves_time;
}

call::Refused timeout(const monitor::After& after, std::uint64_t bytes_in) {
  const std::string message = "line " + std::to_string(after.line) + " has received " +
                              std::to_string(bytes_in) + " of " + std::to_string(after.bytes_in) +
                              " bytes after " + std::to_string(after.within_ms) + " ms";
  return {"timeout", message,
          "nothing was changed; send the bytes, or allow more time by within_ms"};
}

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

/// Waits until a line has received bytes. Returns the error, or nullopt.
asio::awaitable<std::optional<call::Refused>> wait_for_bytes(HostedCell& at, monitor::After after) {
  const Cell& cell = at.cell();
  const bool arrived = co_await at.transports().wait_for_bytes(after.line, after.bytes_in,
                                                               milliseconds(after.within_ms));
  if (!cell.bytes_in(after.line)) co_return no_such_line(after.line);
  if (arrived) co_return std::nullopt;
  if (cell.find_line(after.line) == nullptr) co_return no_such_line(after.line);
  co_return timeout(after, cell.bytes_in(after.line).value_or(0));
}

}  // namespace

monitor::Message refused(const monitor::RequestId& id, const call::Refused& why) {
  return monitor::result({id, why.code, why.message, why.hint, {}});
}

Json value_now(const Cell& cell) { return {{"epoch", cell.epoch()}, {"tick", cell.state().tick}}; }

// With the real clock, a call that moves time is refused without waiting.
asio::awaitable<std::optional<call::Refused>> MonitorCalls::wait(CallOf of) {
  const bool in_real_clock = of.cell().clock().mode() == ClockMode::kReal;
  if (of.wanted.after && !in_real_clock) {
    std::optional<call::Refused> error = co_await wait_for_bytes(*of.at, *of.wanted.after);
    if (error) co_return error;
  }
  if (moves_time(of.wanted)) co_await of.at->transports().read_arrived();
  co_return std::nullopt;
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const call::Call& call) {
  Cell& cell = of.cell();
  if (const auto error = monitor::limit_ticks(of.request, cell.state().tick))
    co_return monitor::result(*error);
  if (!may_enlarge(call))
    co_return refused(of.id(), {"limit", "the server has allocated more than --max-memory",
                                "remove blocks, or restart the server"});
  if (const auto error = validate_snapshot(of.id(), cell.model(), call))
    co_return monitor::result(*error);
  const Applied applied = cell.apply(call, wall_now());
  if (const auto* no = std::get_if<call::Refused>(&applied.outcome))
    co_return refused(of.id(), *no);
  co_return done(of, call, std::get<call::Done>(applied.outcome));
}

/// One cell is bounded by its own limits; many together are bounded here.
bool MonitorCalls::may_enlarge(const call::Call& call) const {
  const bool is_bounded = memory_ != nullptr && !cells_.is_single();
  return !is_bounded || !call::traits_of(call).enlarges || !memory_->is_exceeded();
}

monitor::Message MonitorCalls::done(CallOf of, const call::Call& call, const call::Done& done) {
  const Cell& cell = of.cell();
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

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::ListFaults&) {
  co_return monitor::result(of.id(), value_with_faults(of.cell()));
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::ReadTranscript&) {
  Cell& cell = of.cell();
  cell.catch_up(wall_now());
  if (cell.transcript() == nullptr)
    co_return refused(of.id(), {"no_transcript", "only the byte clock has a transcript",
                                "start with --clock bytes"});
  const TranscriptSummary summary = cell.transcript()->summary();
  Json value = value_now(cell);
  value["sha256"] = transcript_digest(summary, cell.model(), cell.state(), cell.clock_remainder());
  value["lines"] = summary.lines;
  value["bytes_in"] = summary.bytes_in;
  value["bytes_out"] = summary.bytes_out;
  value["marks"] = marks_json(summary);
  co_return monitor::result(of.id(), value);
}

}  // namespace xr3
