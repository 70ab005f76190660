#include "server/robot_port/port.hpp"

#include <spdlog/spdlog.h>

#include <cassert>
#include <utility>

#include "server/robot_port/socket.hpp"

namespace xr3 {
namespace {

constexpr WallNs kOtherPeerLogEvery = 1'000'000'000;

}  // namespace

RobotPort::RobotPort(asio::io_context& io, Cell& cell, LineSessions& lines, RobotPortRules rules)
    : cell_(cell),
      lines_(lines),
      rules_(std::move(rules)),
      listener_(io, "the robot port",
                [this](NewConnection connection) { open(std::move(connection)); }),
      release_(io) {
  lines_.add(*this);
}

void RobotPort::open(NewConnection connection) {
  if (is_full()) lines_.run_events();  // a client may have closed its line without our notice
  if (is_full()) return refuse();      // closed without a byte
  const asio::ip::address peer = machine_of(connection);
  if (is_owned_by_other(peer)) return refuse_other(peer);
  auto place = rules_.peers.take(peer);
  if (!place) return refuse_peer(peer);
  const LineOpened opened{to_text(connection.peer), LineKind::kTcp, rules_.guard};
  ++open_;
  const auto line =
      lines_.open(*this, std::make_unique<RobotSocket>(std::move(connection.descriptor)), opened,
                  std::move(place));
  if (!line || !rules_.owner_lingers) return;
  peers_of_lines_.emplace(*line, peer);
  release_.cancel();
}

void RobotPort::close() {
  is_closed_ = true;
  listener_.close();
  release_.cancel();
}

void RobotPort::refuse() {
  ++refused_;
  if (std::exchange(has_logged_full_, true)) return;
  spdlog::warn("lines are refused: {} are open already (--max-lines; reported once until one ends)",
               rules_.max_lines);
}

void RobotPort::refuse_peer(const asio::ip::address& peer) {
  ++refused_;
  if (std::exchange(has_logged_peer_, true)) return;
  spdlog::warn(
      "lines of {} are refused: it has as many open as one address may have (--max-per-address; "
      "reported once until one ends)",
      peer.to_string());
}

// --- The owner of the port.

void RobotPort::refuse_other(const asio::ip::address& peer) {
  ++other_peers_;
  const WallNs now = wall_now();
  if (now < next_other_log_) return;
  next_other_log_ = now + kOtherPeerLogEvery;
  spdlog::warn(
      "cell {}: {} is disconnected: {} has the robot port (--bind-peer); {} since the start",
      cell_.name(), peer.to_string(), owner_->to_string(), other_peers_);
}

/// The lines of other addresses end before any byte of them acts.
void RobotPort::become_owner(const asio::ip::address& peer) {
  owner_ = peer;
  for (const auto& [line, its_peer] : std::map(peers_of_lines_)) {
    if (its_peer == peer) continue;
    refuse_other(its_peer);
    lines_.disconnect(line);
  }
}

std::optional<asio::ip::address> RobotPort::release_owner() {
  auto released = std::exchange(owner_, std::nullopt);
  for (const auto& [line, peer] : std::map(peers_of_lines_))
    if (peer == released) lines_.disconnect(line);
  return released;
}

void RobotPort::release_later() {
  if (is_closed_) return;
  run_after(release_, std::chrono::nanoseconds(*rules_.owner_lingers), [this] {
    if (peers_of_lines_.empty()) owner_.reset();
  });
}

void RobotPort::line_executed(LineId line) {
  const auto peer = peers_of_lines_.find(line);
  if (peer != peers_of_lines_.end() && !owner_) become_owner(peer->second);
}

void RobotPort::line_ended(LineId line, LineCloseReason) {
  assert(open_ > 0);
  --open_;
  has_logged_full_ = has_logged_peer_ = false;
  if (peers_of_lines_.erase(line) > 0 && peers_of_lines_.empty() && owner_) release_later();
}

}  // namespace xr3
