// The monitor's calls: on the cell, on serial lines, and `describe`.
#include <chrono>
#include <utility>

#include "cell/digest.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

bool moves_time(const monitor::CallRequest& wanted) {
  const auto* call = std::get_if<call::Call>(&wanted.call);
  return call != nullptr && (std::holds_alternative<call::Step>(*call) ||
                             std::holds_alternative<call::RunUntil>(*call));
}

monitor::RequestError no_such_line(LineId line) {
  return {{},
          "no_such_line",
          "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened",
          {}};
}

monitor::RequestError timeout(const monitor::After& after, std::uint64_t bytes_in) {
  const std::string message = "line " + std::to_string(after.line) + " has received " +
                              std::to_string(bytes_in) + " of " + std::to_string(after.bytes_in) +
                              " bytes after " + std::to_string(after.within_ms) + " ms";
  return {{},
          "timeout",
          message,
          "nothing was changed; send the bytes, or allow more time by within_ms",
          {}};
}

/// The error if a client's snapshot has a state that is impossible on this robot; else nullopt.
std::optional<monitor::RequestError> validate_snapshot(const Model& model, const call::Call& call) {
  const auto* load = std::get_if<call::LoadSnapshot>(&call);
  if (load == nullptr || !load->saved || load->saved->robot_hash != robot_hash(model))
    return std::nullopt;
  auto details = monitor::validate(model, *load->saved);
  if (details.empty()) return std::nullopt;
  return monitor::RequestError{{},
                               "bad_args",
                               "the snapshot does not fit the robot",
                               "nothing was changed",
                               std::move(details)};
}

monitor::Message refused(const monitor::RequestId& id, monitor::RequestError error) {
  error.id = id;
  return monitor::result(error);
}

Json line_json(LineId id, const SerialLine& line) {
  return {{"line", id},
          {"kind", name_of(line.kind())},
          {"peer", line.peer()},
          {"opened_tick", line.opened_tick()},
          {"bytes_in", line.bytes_in()},
          {"bytes_out", line.bytes_out()},
          {"warnings", line.warnings()},
          {"last", readable(line.last().view())}};
}

}  // namespace

asio::awaitable<void> MonitorService::call(MonitorSession& session, monitor::Request request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const bool in_manual_clock = cell_.clock().mode() == ClockMode::kManual;
  if (wanted.after && in_manual_clock) {  // the real clock is refused below, without waiting
    Error error = co_await wait_for(*wanted.after);
    if (error) {
      session.client().send(refused(request.id, *std::move(error)));
      co_return;
    }
  }
  if (std::holds_alternative<call::Call>(wanted.call)) {
    session.client().send(call_cell(request));
  } else if (std::holds_alternative<monitor::Send>(wanted.call)) {
    session.client().send(send(session, request));
  } else if (std::holds_alternative<monitor::ListLines>(wanted.call)) {
    session.client().send(list_lines(request));
  } else if (std::holds_alternative<monitor::DisconnectLine>(wanted.call)) {
    session.client().send(disconnect(request));
  } else {
    Json value = value_now();
    value.update(std::get<monitor::Describe>(wanted.call).description);
    session.client().send(monitor::result(request.id, value));
  }
  acted_();
}

// --- Calls of the cell.

asio::awaitable<MonitorService::Error> MonitorService::wait_for(monitor::After after) {
  lines_.read_arrived();
  if (!cell_.bytes_in(after.line)) co_return no_such_line(after.line);
  const bool arrived =
      co_await lines_.wait_for_bytes(after.line, after.bytes_in, milliseconds(after.within_ms));
  if (arrived) co_return std::nullopt;
  if (cell_.find_line(after.line) == nullptr) co_return no_such_line(after.line);
  co_return timeout(after, cell_.bytes_in(after.line).value_or(0));
}

// Not a coroutine: nothing may run between reading the bytes that have arrived and the call that
// must see their effect.
monitor::Message MonitorService::call_cell(monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (moves_time(wanted)) lines_.read_arrived();
  if (const auto error = monitor::limit_ticks(request, cell_.state().tick))
    return monitor::result(*error);
  const auto& call = std::get<call::Call>(wanted.call);
  if (auto error = validate_snapshot(cell_.model(), call))
    return refused(request.id, *std::move(error));
  const Applied applied = cell_.apply(call, wall_now());
  if (const auto* no = std::get_if<call::Refused>(&applied.outcome))
    return refused(request.id, {{}, no->code, no->message, no->hint, {}});
  return done(request, std::get<call::Done>(applied.outcome));
}

monitor::Message MonitorService::done(const monitor::Request& request, const call::Done& done) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const auto& call = std::get<call::Call>(wanted.call);
  Json value = value_now();
  if (done.reached) value["reached"] = *done.reached;
  if (done.ran_ticks) value["ran_ticks"] = *done.ran_ticks;
  if (moves_time(wanted))
    value["state"] = state_json(cell_.model(), cell_.snapshot(), wanted.fields);
  if (done.saved) {
    const auto* save = std::get_if<call::SaveSnapshot>(&call);
    const std::string& name =
        save != nullptr ? save->name : std::get<call::LoadSnapshot>(call).name;
    const Json saved = saved_cell_to_json(*done.saved);
    value["name"] = name.empty() ? Json() : Json(name);
    value["hash"] = sha256(saved.dump());
    if (save != nullptr && name.empty()) value["snapshot"] = saved;
  }
  return monitor::result(request.id, value);
}

Json MonitorService::value_now() const {
  return {{"epoch", cell_.epoch()}, {"tick", cell_.state().tick}};
}

// --- Serial lines.

monitor::Message MonitorService::send(MonitorSession& session, const monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const std::string& bytes = std::get<monitor::Send>(wanted.call).bytes;
  const std::optional<LineId> open_line = session.own_line();
  const bool is_open = open_line && cell_.find_line(*open_line) != nullptr;
  const LineId id = is_open
                        ? *open_line
                        : cell_.apply(LineOpened{"monitor", LineKind::kMonitor}, wall_now()).line;
  if (!is_open) session.set_own_line(id);
  // Camera images can fill the outbox. The client sends the rest of the bytes with the next call,
  // so that no call takes long.
  const std::size_t taken = cell_.apply(BytesIn{id, bytes}, wall_now()).bytes_taken;
  const std::string replies(cell_.find_line(id)->outbox());
  cell_.apply(BytesOut{id, replies.size()}, wall_now());
  Json value = value_now();
  value["line"] = id;
  if (taken < bytes.size()) value["taken"] = taken;
  value["hex"] = hexadecimal(replies);
  value["text"] = readable(replies);
  return monitor::result(request.id, value);
}

monitor::Message MonitorService::list_lines(const monitor::Request& request) {
  cell_.catch_up(wall_now());
  Json lines = Json::array();
  for (const auto& [id, line] : cell_.lines()) lines.push_back(line_json(id, line));
  Json value = value_now();
  value["lines"] = std::move(lines);
  return monitor::result(request.id, value);
}

monitor::Message MonitorService::disconnect(const monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const LineId id = std::get<monitor::DisconnectLine>(wanted.call).line;
  if (cell_.find_line(id) == nullptr) return refused(request.id, no_such_line(id));
  if (!lines_.disconnect(id))
    cell_.apply(LineClosed{id, LineCloseReason::kDisconnected}, wall_now());
  return monitor::result(request.id, value_now());
}

}  // namespace xr3
