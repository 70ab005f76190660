#include "server/robot_session.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
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
    : socket_(std::move(socket)),
      id_(context.cell.apply(LineOpened{name_of(socket_)}, wall_now()).line),
      context_(context) {
  ErrorCode ignored;
  socket_.set_option(asio::socket_base::keep_alive(true), ignored);
}

void RobotSession::start() {
  asio::co_spawn(
      socket_.get_executor(), [self = shared_from_this()] { return self->run(); }, asio::detached);
}

// Reading waits while replies do: a client that does not read its replies is not read either.
asio::awaitable<void> RobotSession::run() {
  while (socket_.is_open()) {
    const bool must_write = !context_.cell.find_line(id_)->outbox().empty();
    const auto event = must_write ? tcp::socket::wait_write : tcp::socket::wait_read;
    const auto [error] = co_await socket_.async_wait(event, kAwait);
    if (!socket_.is_open()) break;
    if (error == asio::error::operation_aborted) continue;  // look again what there is to wait for
    if (error) {
      close(CloseReason::kError);
    } else if (must_write) {
      flush();
    } else {
      take_in(kFairShare);
    }
  }
}

void RobotSession::take_in() {
  take_in(kMostArrived);
  if (socket_.is_open() && !context_.cell.find_line(id_)->outbox().empty()) socket_.cancel();
}

void RobotSession::take_in(std::size_t most) {
  while (socket_.is_open() && !has_ended_ && pending_.empty() && most > 0) {
    const std::size_t wanted = std::min(most, context_.scratch.size());
    const std::size_t count = read(wanted);
    act({context_.scratch.data(), count});
    if (count < wanted) break;  // all that there was
    most -= count;
  }
  flush();
}

// Bytes read into the scratch buffer; 0 where there are none now or, then has_ended_, ever.
std::size_t RobotSession::read(std::size_t most) {
  ErrorCode error;
  const std::size_t count = socket_.read_some(asio::buffer(context_.scratch.data(), most), error);
  if (error == asio::error::eof) {
    has_ended_ = true;
  } else if (error && error != asio::error::would_block && error != asio::error::try_again) {
    close(CloseReason::kError);
  }
  return count;
}

void RobotSession::act(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::size_t taken = context_.cell.apply(BytesIn{id_, bytes}, wall_now()).bytes_taken;
  context_.acted();
  if (context_.cell.find_line(id_)->is_stranger()) return close(CloseReason::kStranger);
  pending_.append(bytes.substr(taken));
}

void RobotSession::act_on_pending() {
  const std::string bytes = std::exchange(pending_, {});
  act(bytes);
}

// Sends what the socket takes now, and goes on with the bytes that had to wait for it.
void RobotSession::flush() {
  while (socket_.is_open()) {
    Line& line = *context_.cell.find_line(id_);
    if (line.outbox().empty() && pending_.empty()) break;
    ErrorCode error;
    line.sent(socket_.write_some(asio::buffer(line.outbox()), error));
    if (error == asio::error::would_block || error == asio::error::try_again) return;
    if (error) return close(CloseReason::kError);
    if (!line.is_full()) act_on_pending();
  }
  if (has_ended_) close(end_);
}

void RobotSession::finish() {
  has_ended_ = true;
  end_ = CloseReason::kShutdown;
  pending_.clear();
  flush();
}

void RobotSession::close(CloseReason reason) {
  if (!socket_.is_open()) return;
  ErrorCode ignored;
  socket_.shutdown(tcp::socket::shutdown_send, ignored);
  socket_.close(ignored);
  context_.cell.apply(LineClosed{id_, reason}, wall_now());
  context_.ended(id_);
}

}  // namespace xr3
