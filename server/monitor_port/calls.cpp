// The monitor's calls on a cell and its serial lines.
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cell/digest.hpp"
#include "cell/rewind.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/monitor/saved_faults.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

// Longer answers are made in the worker. A line takes some 10 us, a byte of the replies to `send` some 20 ns.
constexpr std::size_t kMaxLinesAtOnce = 50;
constexpr std::size_t kMaxReplyBytesAtOnce = 4096;
constexpr WallNs kMaxSendTime = 2'000'000;

bool moves_time(const monitor::CallRequest& wanted) {
  const auto* call = std::get_if<call::Call>(&wanted.call);
  return call != nullptr && (std::holds_alternative<call::Step>(*call) ||
                             std::holds_alternative<call::RunUntil>(*call));
}

bool concerns_past(const monitor::CallRequest& wanted) {
  const auto& call = wanted.call;
  return std::holds_alternative<monitor::ReadHistory>(call) ||
         std::holds_alternative<monitor::Look>(call) ||
         std::holds_alternative<monitor::Live>(call) ||
         std::holds_alternative<monitor::Seek>(call) ||
         std::holds_alternative<monitor::Branch>(call);
}

bool concerns_faults(const monitor::CallRequest& wanted) {
  const auto* call = std::get_if<call::Call>(&wanted.call);
  return call != nullptr && (std::holds_alternative<call::SetFault>(*call) ||
                             std::holds_alternative<call::ClearFault>(*call));
}

monitor::RequestError no_such_line(LineId line) {
  return {{},
          "no_such_line",
          "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened",
          {}};
}

monitor::RequestError line_waits(LineId current) {
  const std::string line = "line " + std::to_string(current);
  return {{},
          "line_waits",
          "the byte clock obeys one line at a time, and " + line + " is open",
          "close " + line + ", also by line_disconnect, or start with --concurrent-lines",
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

monitor::RequestError too_many_lines() {
  return {{},
          "limit",
          "this client has lines of its own in 64 cells",
          "close one by line_disconnect, or use another connection",
          {}};
}

monitor::RequestError no_memory() {
  return {{},
          "limit",
          "the server has allocated more than --max-memory",
          "remove blocks, or restart the server",
          {}};
}

/// Whether a call can make a cell larger for good.
bool enlarges(const call::Call& call) {
  const auto* save = std::get_if<call::SaveSnapshot>(&call);
  return std::holds_alternative<call::AddBlock>(call) ||
         std::holds_alternative<call::ReplaceWorkcell>(call) ||
         std::holds_alternative<call::LoadSnapshot>(call) ||
         (save != nullptr && !save->name.empty());
}

monitor::Message refused(const monitor::RequestId& id, monitor::RequestError error) {
  error.id = id;
  return monitor::result(error);
}

/// A line as the call `lines` shows it.
struct LineEntry {
  LineId id;
  LineKind kind;
  std::string peer;
  Tick opened_tick;
  std::uint64_t bytes_in;
  std::uint64_t bytes_acted;
  std::uint64_t bytes_out;
  std::uint64_t warnings;
  RawBytes last;
  std::optional<SerialSettings> serial;
  std::optional<SerialSettings> speed;
  std::optional<LineId> waits_for;
};

LineEntry entry_of(const Cell& cell, LineId id, const SerialLine& line) {
  return {id,
          line.kind(),
          line.peer(),
          line.opened_tick(),
          line.bytes_in(),
          line.bytes_acted(),
          line.bytes_out(),
          line.warnings(),
          line.last(),
          line.settings(),
          cell.speed_of(line),
          cell.line_before(id)};
}

Json line_json(const LineEntry& line) {
  Json entry = {{"line", line.id},
                {"kind", name_of(line.kind)},
                {"peer", line.peer},
                {"opened_tick", line.opened_tick},
                {"bytes_in", line.bytes_in},
                {"bytes_acted", line.bytes_acted},
                {"bytes_out", line.bytes_out},
                {"warnings", line.warnings},
                {"last", readable(line.last.view())}};
  if (line.serial) entry["serial"] = text_of(*line.serial);
  if (line.speed) entry["speed"] = text_of(*line.speed);
  if (line.waits_for) entry["waits_for"] = *line.waits_for;
  return entry;
}

/// The physical controller, as `lines` shows it beside the lines: it has no number.
Json device_line_json(const DeviceLink& device) {
  const auto opened = device.opened_tick();
  return {{"kind", name_of(LineKind::kDevice)}, {"peer", device.path()},
          {"open", device.is_open()},           {"opened_tick", opened ? Json(*opened) : Json()},
          {"bytes_in", device.bytes_in()},      {"bytes_out", device.bytes_out()},
          {"last", readable(device.last())},    {"serial", text_of(device.settings())}};
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

Json value_now(const Cell& cell) { return {{"epoch", cell.epoch()}, {"tick", cell.state().tick}}; }

MonitorService::Answer MonitorService::at_once(const monitor::Message& message) {
  return {[message] { return message; }};
}

asio::awaitable<void> MonitorService::call(CellPtr at, MonitorSession& session,
                                           monitor::Request request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (concerns_past(wanted)) {
    co_await call_past(std::move(at), session, std::move(request));
    co_return;
  }
  const bool in_real_clock = at->cell().clock().mode() == ClockMode::kReal;
  if (wanted.after && !in_real_clock) {  // the real clock is refused below, without waiting
    Error error = co_await wait_for(*at, *wanted.after);
    if (error) {
      session.client().send(refused(request.id, *std::move(error)));
      co_return;
    }
  }
  co_await making_long_.until_free();
  if (at->is_retired()) {
    session.client().send(monitor::result(monitor::unknown_cell(request, visible_cells(session))));
    co_return;
  }
  Answer answer = carry_out_call(*at, session, request);
  at->acted();
  monitor::Message message;
  if (answer.is_long) {
    message = co_await make_long(std::move(answer));
  } else {
    message = answer.make();
  }
  session.client().send(std::move(message));
}

// Meanwhile other calls wait, so that one copy of a large state exists at most, however many
// clients have called.
asio::awaitable<monitor::Message> MonitorService::make_long(Answer answer) {
  const Exclusive::Hold hold(making_long_);
  monitor::Message message = co_await worker_.run(std::move(answer.make));
  co_return message;
}

// Not a coroutine: the call takes effect before anything else runs.
MonitorService::Answer MonitorService::carry_out_call(HostedCell& at, MonitorSession& session,
                                                      monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (std::holds_alternative<call::Call>(wanted.call)) return call_cell(at, request);
  if (std::holds_alternative<monitor::Send>(wanted.call)) return send(at, session, request);
  if (std::holds_alternative<monitor::ListLines>(wanted.call)) return list_lines(at, request);
  if (std::holds_alternative<monitor::ListFaults>(wanted.call))
    return at_once(monitor::result(request.id, value_with_faults(at.cell())));
  if (std::holds_alternative<monitor::DisconnectLine>(wanted.call))
    return at_once(disconnect(at, request));
  return transcript(at, request);
}

// --- Calls of the cell.

asio::awaitable<MonitorService::Error> MonitorService::wait_for(HostedCell& at,
                                                                monitor::After after) {
  const Cell& cell = at.cell();
  const bool arrived = co_await at.transports().wait_for_bytes(after.line, after.bytes_in,
                                                               milliseconds(after.within_ms));
  if (!cell.bytes_in(after.line)) co_return no_such_line(after.line);
  if (arrived) co_return std::nullopt;
  if (cell.find_line(after.line) == nullptr) co_return no_such_line(after.line);
  co_return timeout(after, cell.bytes_in(after.line).value_or(0));
}

// Not a coroutine: nothing may run between reading the bytes that have arrived and the call that
// must see their effect.
MonitorService::Answer MonitorService::call_cell(HostedCell& at, monitor::Request& request) {
  Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (moves_time(wanted)) at.transports().read_arrived();
  if (const auto error = monitor::limit_ticks(request, cell.state().tick))
    return at_once(monitor::result(*error));
  const auto& call = std::get<call::Call>(wanted.call);
  if (!may_enlarge(call)) return at_once(refused(request.id, no_memory()));
  if (auto error = validate_snapshot(cell.model(), call))
    return at_once(refused(request.id, *std::move(error)));
  const Applied applied = cell.apply(call, wall_now());
  if (const auto* no = std::get_if<call::Refused>(&applied.outcome))
    return at_once(refused(request.id, {{}, no->code, no->message, no->hint, {}}));
  return done(at, request, std::get<call::Done>(applied.outcome));
}

/// One cell is bounded by its own limits; many together are bounded here.
bool MonitorService::may_enlarge(const call::Call& call) const {
  const bool is_bounded = memory_ != nullptr && !cells_.is_single();
  return !is_bounded || !enlarges(call) || !memory_->is_exceeded();
}

MonitorService::Answer MonitorService::done(HostedCell& at, const monitor::Request& request,
                                            const call::Done& done) {
  const Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  Json value = value_now(cell);
  if (done.reached) value["reached"] = *done.reached;
  if (done.ran_ticks) value["ran_ticks"] = *done.ran_ticks;
  if (concerns_faults(wanted)) return at_once(monitor::result(request.id, value_with_faults(cell)));
  const bool is_large = cell.state().blocks.size() > FrameMaker::kMaxBlocksAtOnce;
  if (moves_time(wanted)) {
    return {[id = request.id, fields = wanted.fields, model = cell.model_ptr(),
             now = cell.snapshot(), value]() mutable {
              value["state"] = state_json(*model, now, fields);
              return monitor::result(id, value);
            },
            is_large};
  }
  if (!done.saved) return at_once(monitor::result(request.id, value));
  const auto& call = std::get<call::Call>(wanted.call);
  const std::string name = snapshot_name(call);
  const bool is_inline = name.empty() && std::holds_alternative<call::SaveSnapshot>(call);
  return {[id = request.id, saved = done.saved, name, is_inline, value]() mutable {
            add_saved(*saved, name, is_inline, value);
            return monitor::result(id, value);
          },
          is_large};
}

// --- Serial lines.

std::optional<LineId> MonitorService::open_own_line(const HostedCell& at, MonitorSession& session) {
  const std::map<std::string, LineId>& lines = session.own_lines();
  const auto known = lines.find(at.name());
  if (known == lines.end() || at.cell().find_line(known->second) == nullptr) return std::nullopt;
  return known->second;
}

std::optional<LineId> MonitorService::own_line(HostedCell& at, MonitorSession& session) {
  if (const std::optional<LineId> open = open_own_line(at, session)) return open;
  std::map<std::string, LineId>& lines = session.own_lines();
  const auto is_closed = [this](const auto& line) {
    const CellPtr cell = cells_.find(line.first);
    return !cell || cell->cell().find_line(line.second) == nullptr;
  };
  if (lines.size() >= kMaxOwnLines) std::erase_if(lines, is_closed);
  if (lines.size() >= kMaxOwnLines) return std::nullopt;
  const LineId opened = at.cell().apply(LineOpened{"monitor", LineKind::kMonitor}, wall_now()).line;
  lines[at.name()] = opened;
  return opened;
}

MonitorService::Answer MonitorService::send(HostedCell& at, MonitorSession& session,
                                            const monitor::Request& request) {
  Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const std::string& bytes = std::get<monitor::Send>(wanted.call).bytes;
  if (cell.is_in_past()) {
    const call::Refused no = in_the_past();
    return at_once(refused(request.id, {{}, no.code, no.message, no.hint, {}}));
  }
  if (const std::optional<LineId> current = cell.current_line();
      current && current != open_own_line(at, session))
    return at_once(refused(request.id, line_waits(*current)));
  const std::optional<LineId> line = own_line(at, session);
  if (!line) return at_once(refused(request.id, too_many_lines()));
  const LineId id = *line;
  // Camera images can fill the outbox, and with the byte clock each byte takes work. The client
  // sends the rest of the bytes with the next call, so that no call takes long.
  const bool moves_time = cell.clock().mode() == ClockMode::kBytes;
  const WallNs end = moves_time ? wall_now() + kMaxSendTime : kNever;
  const auto is_enough = [end] { return wall_now() >= end; };
  const std::size_t taken = cell.apply(BytesIn{id, bytes, is_enough}, wall_now()).bytes_taken;
  std::string replies(cell.find_line(id)->outbox());
  cell.apply(BytesOut{id, replies.size()}, wall_now());
  Json value = value_now(cell);
  value["line"] = id;
  if (taken < bytes.size()) value["taken"] = taken;
  const bool is_long = replies.size() > kMaxReplyBytesAtOnce;
  return {[id = request.id, value, replies = std::move(replies)]() mutable {
            value["hex"] = hexadecimal(replies);
            value["text"] = readable(replies);
            return monitor::result(id, value);
          },
          is_long};
}

MonitorService::Answer MonitorService::list_lines(HostedCell& at, const monitor::Request& request) {
  Cell& cell = at.cell();
  cell.catch_up(wall_now());
  std::vector<LineEntry> lines;
  for (const auto& [id, line] : cell.lines()) lines.push_back(entry_of(cell, id, line));
  const bool is_long = lines.size() > kMaxLinesAtOnce;
  Json value = value_now(cell);
  if (cell.device() != nullptr) value["device"] = device_line_json(*cell.device());
  return {[id = request.id, value = std::move(value), lines = std::move(lines)]() mutable {
            Json& list = value["lines"] = Json::array();
            for (const LineEntry& line : lines) list.push_back(line_json(line));
            return monitor::result(id, value);
          },
          is_long};
}

monitor::Message MonitorService::disconnect(HostedCell& at, const monitor::Request& request) {
  Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const LineId id = std::get<monitor::DisconnectLine>(wanted.call).line;
  if (cell.find_line(id) == nullptr) return refused(request.id, no_such_line(id));
  if (!at.transports().disconnect(id))
    cell.apply(LineClosed{id, LineCloseReason::kDisconnected}, wall_now());
  return monitor::result(request.id, value_now(cell));
}

}  // namespace xr3
