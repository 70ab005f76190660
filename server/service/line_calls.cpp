// The monitor's calls on serial lines: `send`, `lines`, `line_disconnect` and `peer_release`.
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "server/net/wall_clock.hpp"
#include "server/service/calls.hpp"

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
  if (const auto speed = speed_of(cell.value(), line)) entry["speed"] = text_of(*speed);
  if (const auto before = line_before(cell.value(), id)) entry["waits_for"] = *before;
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

/// The open line that the session has at the cell; nullopt if it has none.
std::optional<LineId> open_own_line(const CallOf& of) {
  const std::map<std::string, LineId>& lines = of.session.own_lines();
  const auto known = lines.find(of.at->name());
  if (known == lines.end() || of.cell().find_line(known->second) == nullptr) return std::nullopt;
  return known->second;
}

// Camera images can fill the outbox. The client sends the rest of the bytes with the next call, so
// that no call takes long.
asio::awaitable<std::size_t> receive(HostedCell& at, LineId line, std::string_view bytes) {
  Cell& cell = at.cell();
  const WallNs end = wall_now() + kMaxSendTime;
  for (std::size_t taken = 0;;) {
    const bool moves_time = cell.clock().mode() == ClockMode::kBytes;
    const WallNs piece_end = moves_time ? wall_now() + kSendPiece : kNever;
    const auto is_enough = [piece_end] { return wall_now() >= piece_end; };
    taken += cell.apply(BytesIn{line, bytes.substr(taken)}, wall_now(), is_enough).bytes_taken;
    if (taken == bytes.size() || wall_now() < piece_end || wall_now() >= end) co_return taken;
    co_await at.transports().pause();
    if (cell.find_line(line) == nullptr || cell.is_in_past()) co_return taken;
  }
}

}  // namespace

call::Refused no_such_line(LineId line) {
  return {"no_such_line", "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened"};
}

std::optional<LineId> MonitorCalls::own_line(CallOf of) {
  if (const std::optional<LineId> open = open_own_line(of)) return open;
  std::map<std::string, LineId>& lines = of.session.own_lines();
  const auto is_closed = [this](const auto& line) {
    const CellPtr cell = cells_.find(line.first);
    return !cell || cell->cell().find_line(line.second) == nullptr;
  };
  if (lines.size() >= kMaxOwnLines) std::erase_if(lines, is_closed);
  if (lines.size() >= kMaxOwnLines) return std::nullopt;
  const LineId opened = of.cell().apply(LineOpened{"monitor", LineKind::kMonitor}, wall_now()).line;
  lines[of.at->name()] = opened;
  return opened;
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::Send& send) {
  Cell& cell = of.cell();
  if (cell.is_in_past()) co_return refused(of.id(), in_the_past());
  if (const std::optional<LineId> current = current_line(cell.value());
      current && current != open_own_line(of))
    co_return refused(of.id(), line_waits(*current));
  const std::optional<LineId> line = own_line(of);
  if (!line) co_return refused(of.id(), too_many_lines());
  const std::size_t taken = co_await receive(*of.at, *line, send.bytes);
  if (cell.find_line(*line) == nullptr) co_return refused(of.id(), no_such_line(*line));
  const std::string replies(cell.find_line(*line)->outbox());
  cell.sent({*line, replies.size()});
  Json value = value_now(cell);
  value["line"] = *line;
  if (taken < send.bytes.size()) value["taken"] = taken;
  value["hex"] = hexadecimal(replies);
  value["text"] = readable(replies);
  co_return monitor::result(of.id(), value);
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::ListLines&) {
  Cell& cell = of.cell();
  cell.catch_up(wall_now());
  Json value = value_now(cell);
  if (cell.device() != nullptr) value["device"] = device_line_json(*cell.device());
  Json& lines = value["lines"] = Json::array();
  for (const auto& [id, line] : cell.lines()) lines.push_back(line_json(cell, id, line));
  co_return monitor::result(of.id(), value);
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::DisconnectLine& disconnect) {
  Cell& cell = of.cell();
  const LineId id = disconnect.line;
  if (cell.find_line(id) == nullptr) co_return refused(of.id(), no_such_line(id));
  if (!of.at->transports().disconnect(id))
    cell.apply(LineClosed{id, LineCloseReason::kDisconnected}, wall_now());
  co_return monitor::result(of.id(), value_now(cell));
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::ReleasePeer&) {
  const auto owner = of.at->port() ? of.at->port()->release_owner() : std::nullopt;
  Json value = value_now(of.cell());
  value["owner"] = owner ? Json(owner->to_string()) : Json();
  co_return monitor::result(of.id(), value);
}

}  // namespace xr3
