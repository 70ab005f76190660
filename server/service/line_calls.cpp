// The monitor's calls on serial lines that need the server: `send`, `line_disconnect` and
// `peer_release`.
#include <nlohmann/json.hpp>

#include "server/service/calls.hpp"
#include "service/answer.hpp"
#include "service/lines.hpp"

namespace xr3 {
namespace {

// With the byte clock, the time of a piece of `send`, and of all its pieces: so long that a busy
// machine does not decide how many bytes are taken.
constexpr WallNs kSendPiece = 500'000;
constexpr WallNs kMaxSendTime = 1'000'000'000;

call::Refused too_many_lines() {
  return {"limit", "this client has lines of its own in 64 cells",
          "close one by line_disconnect, or use another connection"};
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

std::optional<LineId> MonitorCalls::own_line(CallOf of) {
  if (const std::optional<LineId> open = open_own_line(of)) return open;
  std::map<std::string, LineId>& lines = of.session.own_lines();
  const auto is_closed = [this](const auto& line) {
    const CellPtr cell = cells_.find(line.first);
    return !cell || cell->cell().find_line(line.second) == nullptr;
  };
  if (lines.size() >= kMaxOwnLines) std::erase_if(lines, is_closed);
  if (lines.size() >= kMaxOwnLines) return std::nullopt;
  const LineId opened = service::open_line(of.cell(), wall_now());
  lines[of.at->name()] = opened;
  return opened;
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::Send& send) {
  if (const auto why = service::refuse_send(of.cell(), open_own_line(of)))
    co_return service::refused(of.id(), *why);
  const std::optional<LineId> line = own_line(of);
  if (!line) co_return service::refused(of.id(), too_many_lines());
  const std::size_t taken = co_await receive(*of.at, *line, send.bytes);
  co_return service::sent(of.now(), send, *line, taken);
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::DisconnectLine& disconnect) {
  Cell& cell = of.cell();
  const LineId id = disconnect.line;
  if (cell.find_line(id) == nullptr) co_return service::refused(of.id(), service::no_such_line(id));
  if (!of.at->transports().disconnect(id))
    cell.apply(LineClosed{id, LineCloseReason::kDisconnected}, wall_now());
  co_return monitor::result(of.id(), service::value_now(cell));
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const monitor::ReleasePeer&) {
  const auto owner = of.at->port() ? of.at->port()->release_owner() : std::nullopt;
  Json value = service::value_now(of.cell());
  value["owner"] = owner ? Json(owner->to_string()) : Json();
  co_return monitor::result(of.id(), value);
}

}  // namespace xr3
