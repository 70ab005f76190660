#include "server/robot_port/port.hpp"

#include <spdlog/spdlog.h>

#include <cassert>
#include <utility>

#include "server/robot_port/socket.hpp"

namespace xr3 {
namespace {

std::string name_of(const tcp::socket& socket) {
  ErrorCode error;
  const auto peer = socket.remote_endpoint(error);
  return error ? "unknown" : to_text(peer);
}

}  // namespace

RobotPort::RobotPort(asio::io_context& io, Cell& cell, LineSessions& lines, RobotPortRules rules)
    : cell_(cell),
      lines_(lines),
      rules_(std::move(rules)),
      listener_(io, "the robot port", [this](tcp::socket socket) { open(std::move(socket)); }) {
  lines_.add(*this);
}

ErrorCode RobotPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void RobotPort::open(tcp::socket socket) {
  const bool is_probe = this->is_probe(socket);
  if (is_full()) lines_.take_news();       // a client may have closed its line without our notice
  if (is_full()) return refuse(is_probe);  // closed without a byte
  const asio::ip::address peer = peer_address(socket);
  auto place = rules_.peers.take(peer);
  if (!place && !is_probe) return refuse_peer(peer);
  const LineOpened opened{name_of(socket), LineKind::kTcp, is_probe, rules_.guard};
  if (!is_probe) ++open_;
  lines_.open(*this, std::make_unique<RobotSocket>(std::move(socket)), opened, std::move(place));
}

void RobotPort::refuse(bool is_probe) {
  if (is_probe) {
    probe_progress_ = ProbeProgress::kRefused;
    return;
  }
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

void RobotPort::line_acted(LineId line) {
  if (line != kProbeLine) return;
  probe_progress_ = cell_.state().enabled ? ProbeProgress::kTaken : ProbeProgress::kIgnored;
}

void RobotPort::line_ended(LineId line, LineCloseReason) {
  if (line == kProbeLine) return;
  assert(open_ > 0);
  --open_;
  has_logged_full_ = has_logged_peer_ = false;
}

void RobotPort::expect_probe(const tcp::endpoint& from) {
  probe_from_ = from;
  probe_progress_ = ProbeProgress::kUnseen;
}

bool RobotPort::is_probe(const tcp::socket& socket) {
  if (!probe_from_) return false;
  ErrorCode error;
  if (socket.remote_endpoint(error) != *probe_from_ || error) return false;
  probe_from_.reset();
  probe_progress_ = ProbeProgress::kAccepted;
  return true;
}

}  // namespace xr3
