#include "server/robot_session.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <new>
#include <utility>

#include "server/listener.hpp"
#include "server/wall_clock.hpp"

namespace xr3 {
namespace {

// Bytes of one line in one turn of the loop, so that a flood leaves room for the other lines: some
// 30 us at 50 ns a byte, what a turn takes anyway.
constexpr std::size_t kFairShare = 512;
// As much as a receive buffer can hold; a drain takes no more even if the client keeps on writing.
constexpr std::size_t kMostArrived = 16 * 1024 * 1024;

std::string name_of(const tcp::socket& socket) {
  ErrorCode error;
  const auto peer = socket.remote_endpoint(error);
  return error ? "unknown" : to_text(peer);
}

}  // namespace

RobotSession::RobotSession(tcp::socket socket, RobotSessionContext& context)
    : RobotSession(name_of(socket), std::move(socket), context) {}

RobotSession::RobotSession(const std::string& peer, tcp::socket&& socket,
                           RobotSessionContext& context)
    : socket_(std::move(socket)),
      id_(context.cell.apply(LineOpened{peer, LineKind::kRaw, context.is_probe}, wall_now()).line),
      context_(context) {}

// Reading waits while replies do: a client that does not read its replies is not read either.
bool RobotSession::take_turn() { return has_flushed() && take_in(kFairShare); }

void RobotSession::take_in() { take_in(kMostArrived); }

// True: so much was read that there may be more.
bool RobotSession::take_in(std::size_t most) {
  bool has_more = true;
  while (socket_.is_open() && !has_ended_ && pending_.empty() && has_more && most > 0) {
    const std::size_t wanted = std::min(most, context_.scratch.size());
    const std::size_t count = read(wanted);
    act({context_.scratch.data(), count});
    has_more = count == wanted || (is_ending_ && count > 0);
    most -= count;
  }
  return has_flushed() && has_more && !has_ended_;
}

// Bytes read into the scratch buffer; 0 where there are none now or, then has_ended_, ever.
std::size_t RobotSession::read(std::size_t most) {
  const std::size_t count = socket_.read(context_.scratch.first(most));
  has_ended_ = socket_.has_ended();
  if (socket_.is_lost()) close(CloseReason::kError);
  return count;
}

void RobotSession::act(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::size_t taken = context_.cell.apply(BytesIn{id_, bytes}, wall_now()).bytes_taken;
  context_.acted();
  if (!socket_.is_open()) return;
  if (context_.cell.find_line(id_)->is_stranger()) return close(CloseReason::kStranger);
  if (taken < bytes.size()) keep(bytes.substr(taken));
}

// Where memory is short this line ends, and no other.
void RobotSession::keep(std::string_view bytes) {
  try {
    pending_.append(bytes);
  } catch (const std::bad_alloc&) {
    spdlog::error("line {}: no memory for its bytes; it is closed", id_);
    close(CloseReason::kError);
  }
}

void RobotSession::act_on_pending() {
  const std::string bytes = std::exchange(pending_, {});
  act(bytes);
}

// Sends what the socket takes now, and goes on with the bytes that had to wait for it. True: nothing is
// left, and the connection goes on.
bool RobotSession::has_flushed() {
  if (!socket_.is_open()) return false;
  Line& line = *context_.cell.find_line(id_);  // as long as the socket is open
  while (!line.outbox().empty() || !pending_.empty()) {
    const std::size_t count = socket_.write(line.outbox());
    if (socket_.is_lost()) close(CloseReason::kError);
    if (!socket_.is_open()) return false;
    line.sent(count);
    if (count == 0 && !line.outbox().empty()) return false;
    if (!line.is_full()) act_on_pending();
    if (!socket_.is_open()) return false;
  }
  if (has_ended_) close(end_);
  return socket_.is_open();
}

void RobotSession::finish() {
  has_ended_ = true;
  end_ = CloseReason::kShutdown;
  pending_.clear();
  has_flushed();
}

void RobotSession::close(CloseReason reason) {
  if (!socket_.is_open()) return;
  socket_.close();
  context_.cell.apply(LineClosed{id_, reason}, wall_now());
  context_.ended(id_);
}

}  // namespace xr3
