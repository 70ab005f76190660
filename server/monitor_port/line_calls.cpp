// The monitor's calls on serial lines: `send`, `lines`, `line_disconnect` and `peer_release`.
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// With the byte clock, the time of a piece of `send`, and of all its pieces: so long that a busy
// machine does not decide how many bytes are taken.
constexpr WallNs kSendPiece = 500'000;
constexpr WallNs kMaxSendTime = 1'000'000'000;

call::Refused line_waits(LineId current) {
  const std::string line = "line " + std::to_string(current);
  return {"line_waits", "the byte clock obeys one line at a time, and " + line + " is open",
          "close " + line + ", also by line_disconnect, or start with --concurrent-lines"};
}

call::Refused too_many_lines() {
  return {"limit", "this client has lines of its own in 64 cells",
          "close one by line_disconnect, or use another connection"};
}

Json line_json(const Cell& cell, LineId id, const SerialLine& line) {
  Json entry = {{"line", id},
                {"kind", name_of(line.kind())},
                {"peer", line.peer()},
                {"opened_tick", line.opened_tick()},
                {"bytes_in", line.bytes_in()},
                {"bytes_acted", line.bytes_acted()},
                {"bytes_out", line.bytes_out()},
                {"warnings", line.warnings()},
                {"last", readable(line.last().view())}};
  if (const auto serial = line.settings()) entry["serial"] = text_of(*serial);
  if (const auto speed = cell.speed_of(line)) entry["speed"] = text_of(*speed);
  if (const auto before = cell.line_before(id)) entry["waits_for"] = *before;
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

}  // namespace

call::Refused no_such_line(LineId line) {
  return {"no_such_line", "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened"};
}

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

// Camera images can fill the outbox. The client sends the rest of the bytes with the next call, so
// that no call takes long.
asio::awaitable<std::size_t> MonitorService::receive(HostedCell& at, LineId line,
                                                     std::string_view bytes) {
  Cell& cell = at.cell();
  const WallNs end = wall_now() + kMaxSendTime;
  for (std::size_t taken = 0;;) {
    const bool moves_time = cell.clock().mode() == ClockMode::kBytes;
    const WallNs piece_end = moves_time ? wall_now() + kSendPiece : kNever;
    const auto is_enough = [piece_end] { return wall_now() >= piece_end; };
    taken += cell.apply(BytesIn{line, bytes.substr(taken), is_enough}, wall_now()).bytes_taken;
    if (taken == bytes.size() || wall_now() < piece_end || wall_now() >= end) co_return taken;
    co_await at.transports().pause();
    if (cell.find_line(line) == nullptr || cell.is_in_past()) co_return taken;
  }
}

asio::awaitable<monitor::Message> MonitorService::send(HostedCell& at, MonitorSession& session,
                                                       const monitor::Request& request) {
  Cell& cell = at.cell();
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const std::string& bytes = std::get<monitor::Send>(wanted.call).bytes;
  if (cell.is_in_past()) co_return refused(request.id, Cell::in_the_past());
  if (const std::optional<LineId> current = cell.current_line();
      current && current != open_own_line(at, session))
    co_return refused(request.id, line_waits(*current));
  const std::optional<LineId> line = own_line(at, session);
  if (!line) co_return refused(request.id, too_many_lines());
  const std::size_t taken = co_await receive(at, *line, bytes);
  if (cell.find_line(*line) == nullptr) co_return refused(request.id, no_such_line(*line));
  const std::string replies(cell.find_line(*line)->outbox());
  cell.sent({*line, replies.size()});
  Json value = value_now(cell);
  value["line"] = *line;
  if (taken < bytes.size()) value["taken"] = taken;
  value["hex"] = hexadecimal(replies);
  value["text"] = readable(replies);
  co_return monitor::result(request.id, value);
}

monitor::Message MonitorService::list_lines(HostedCell& at, const monitor::Request& request) {
  Cell& cell = at.cell();
  cell.catch_up(wall_now());
  Json value = value_now(cell);
  if (cell.device() != nullptr) value["device"] = device_line_json(*cell.device());
  Json& lines = value["lines"] = Json::array();
  for (const auto& [id, line] : cell.lines()) lines.push_back(line_json(cell, id, line));
  return monitor::result(request.id, value);
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

monitor::Message MonitorService::release_peer(HostedCell& at, const monitor::Request& request) {
  const auto owner = at.port() ? at.port()->release_owner() : std::nullopt;
  Json value = value_now(at.cell());
  value["owner"] = owner ? Json(owner->to_string()) : Json();
  return monitor::result(request.id, value);
}

}  // namespace xr3
