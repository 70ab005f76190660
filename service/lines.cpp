#include "service/lines.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "service/answer.hpp"

namespace xr3::service {
namespace {

call::Refused line_waits(LineId current) {
  const std::string line = "line " + std::to_string(current);
  return {"line_waits", "the byte clock obeys one line at a time, and " + line + " is open",
          "close " + line + ", also by line_disconnect, or start with --concurrent-lines"};
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

}  // namespace

std::optional<call::Refused> refuse_send(const Cell& cell, std::optional<LineId> own) {
  if (cell.is_in_past()) return in_the_past();
  const std::optional<LineId> current = current_line(cell.value());
  if (current && current != own) return line_waits(*current);
  return std::nullopt;
}

LineId open_line(Cell& cell, WallNs now) {
  return cell.apply(LineOpened{"monitor", LineKind::kMonitor}, now).line;
}

monitor::Message sent(const CellCall& of, const monitor::Send& send, LineId line,
                      std::size_t taken) {
  Cell& cell = of.cell;
  if (cell.find_line(line) == nullptr) return refused(of.id(), no_such_line(line));
  const std::string replies(cell.find_line(line)->outbox());
  cell.sent({line, replies.size()});
  Json value = value_now(cell);
  value["line"] = line;
  if (taken < send.bytes.size()) value["taken"] = taken;
  value["hex"] = hexadecimal(replies);
  value["text"] = readable(replies);
  return monitor::result(of.id(), value);
}

monitor::Message carry_out(const CellCall& of, const monitor::ListLines&) {
  Cell& cell = of.cell;
  cell.catch_up(of.now);
  Json value = value_now(cell);
  if (cell.device() != nullptr) value["device"] = device_line_json(*cell.device());
  Json& lines = value["lines"] = Json::array();
  for (const auto& [id, line] : cell.lines()) lines.push_back(line_json(cell, id, line));
  return monitor::result(of.id(), value);
}

}  // namespace xr3::service
