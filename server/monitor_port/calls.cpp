// The monitor's calls on a cell.
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/digest.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/monitor/saved_faults.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

/// Whether a variant holds one of these types.
template <class... Types, class Variant>
bool holds_any(const Variant& variant) {
  return (std::holds_alternative<Types>(variant) || ...);
}

bool concerns_past(const monitor::CallRequest& wanted) {
  return holds_any<monitor::ReadHistory, monitor::Look, monitor::Live, monitor::Seek,
                   monitor::Branch>(wanted.call);
}

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

/// The name under which a snapshot is saved or loaded; empty: inline.
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

}  // namespace

monitor::Message refused(const monitor::RequestId& id, const call::Refused& why) {
  return monitor::result({id, why.code, why.message, why.hint, {}});
}

Json value_now(const Cell& cell) { return {{"epoch", cell.epoch()}, {"tick", cell.state().tick}}; }

asio::awaitable<void> MonitorService::call(CellPtr at, MonitorSession& session,
                                           monitor::Request request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (concerns_past(wanted)) {
    co_await call_past(std::move(at), session, std::move(request));
    co_return;
  }
  const bool in_real_clock = at->cell().clock().mode() == ClockMode::kReal;
  if (wanted.after && !in_real_clock) {  // the real clock is refused below, without waiting
    const std::optional<call::Refused> error = co_await wait_for(*at, *wanted.after);
    if (error) {
      session.send(refused(request.id, *error));
      co_return;
    }
  }
  if (moves_time(wanted)) co_await at->transports().read_arrived();
  if (at->is_retired()) {
    session.send(unknown_cell(session, request));
    co_return;
  }
  monitor::Message answer;
  if (std::holds_alternative<monitor::Send>(wanted.call))
    answer = co_await send(*at, session, request);
  else
    answer = carry_out_call(*at, request);
  at->acted();
  session.send(std::move(answer));
}

// Carries out a call other than `send`. Not a coroutine: it takes effect before anything else runs.
monitor::Message MonitorService::carry_out_call(HostedCell& at, monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (std::holds_alternative<call::Call>(wanted.call)) return call_cell(at, request);
  if (std::holds_alternative<monitor::ListLines>(wanted.call)) return list_lines(at, request);
  if (std::holds_alternative<monitor::ListFaults>(wanted.call))
    return monitor::result(request.id, value_with_faults(at.cell()));
  if (std::holds_alternative<monitor::DisconnectLine>(wanted.call)) return disconnect(at, request);
  if (std::holds_alternative<monitor::ReleasePeer>(wanted.call)) return release_peer(at, request);
  return transcript(at, request);
}

// --- Calls of the cell.

asio::awaitable<std::optional<call::Refused>> MonitorService::wait_for(HostedCell& at,
                                                                       monitor::After after) {
  const Cell& cell = at.cell();
  const bool arrived = co_await at.transports().wait_for_bytes(after.line, after.bytes_in,
                                                               milliseconds(after.within_ms));
  if (!cell.bytes_in(after.line)) co_return no_such_line(after.line);
  if (arrived) co_return std::nullopt;
  if (cell.find_line(after.line) == nullptr) co_return no_such_line(after.line);
  co_return timeout(after, cell.bytes_in(after.line).value_or(0));
}

monitor::Message MonitorService::call_cell(HostedCell& at, monitor::Request& request) {
  Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const auto& call = std::get<call::Call>(wanted.call);
  if (const auto error = monitor::limit_ticks(request, cell.state().tick))
    return monitor::result(*error);
  if (!may_enlarge(call))
    return refused(request.id, {"limit", "the server has allocated more than --max-memory",
                                "remove blocks, or restart the server"});
  if (const auto error = validate_snapshot(request.id, cell.model(), call))
    return monitor::result(*error);
  const Applied applied = cell.apply(call, wall_now());
  if (const auto* no = std::get_if<call::Refused>(&applied.outcome))
    return refused(request.id, *no);
  return done(at, request, std::get<call::Done>(applied.outcome));
}

/// One cell is bounded by its own limits; many together are bounded here.
bool MonitorService::may_enlarge(const call::Call& call) const {
  const bool is_bounded = memory_ != nullptr && !cells_.is_single();
  return !is_bounded || !call::traits_of(call).enlarges || !memory_->is_exceeded();
}

monitor::Message MonitorService::done(HostedCell& at, const monitor::Request& request,
                                      const call::Done& done) {
  const Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const auto& call = std::get<call::Call>(wanted.call);
  Json value = value_now(cell);
  if (done.reached) value["reached"] = *done.reached;
  if (done.ran_ticks) value["ran_ticks"] = *done.ran_ticks;
  const call::Traits traits = call::traits_of(call);
  if (traits.returns_faults) return monitor::result(request.id, value_with_faults(cell));
  if (traits.moves_time) value["state"] = state_json(cell.model(), cell.snapshot(), wanted.fields);
  if (done.saved) {
    const std::string name = snapshot_name(call);
    const bool is_inline = name.empty() && std::holds_alternative<call::SaveSnapshot>(call);
    add_saved(*done.saved, name, is_inline, value);
  }
  return monitor::result(request.id, value);
}

}  // namespace xr3
