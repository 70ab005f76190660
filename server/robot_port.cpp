#include "server/robot_port.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "server/wall_clock.hpp"

namespace xr3 {

RobotPort::RobotPort(asio::io_context& io, Cell& cell, std::size_t most_lines,
                     std::function<void()> acted)
    : io_(io),
      cell_(cell),
      most_lines_(most_lines),
      acted_(std::move(acted)),
      context_{cell, scratch_, [this] { tell(); },
               [this](LineId line) {
                 sessions_.erase(line);
                 tell();
               }},
      listener_(io, [this](tcp::socket socket) { open(std::move(socket)); }) {}

ErrorCode RobotPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void RobotPort::open(tcp::socket socket) {
  if (sessions_.size() >= most_lines_) {
    spdlog::warn("line refused: {} lines are open already (--max-lines)", sessions_.size());
    return;  // closed without a byte
  }
  const int descriptor = socket.native_handle();
  const auto session = std::make_shared<RobotSession>(std::move(socket), context_);
  watch_.add(descriptor, session->line());
  sessions_.emplace(session->line(), session);
  session->start();
  tell();
}

bool RobotPort::disconnect(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return false;
  const auto session = found->second;  // it takes itself out of the map
  session->close(CloseReason::kDisconnected);
  return true;
}

void RobotPort::take_in_news() {
  for (const LineId line : watch_.news()) {
    const auto found = sessions_.find(line);
    if (found == sessions_.end()) continue;
    const auto session = found->second;  // it may take itself out of the map
    session->take_in();
  }
}

// A copy of the map: a session that ends takes itself out of it.
void RobotPort::take_in() {
  listener_.accept_pending();
  for (const auto& [id, session] : sessions()) session->take_in();
}

asio::awaitable<bool> RobotPort::wait_for_bytes(LineId id, std::uint64_t bytes_in,
                                                std::chrono::milliseconds within) {
  asio::steady_timer timer(io_, within);
  const auto deadline = timer.expiry();
  for (;;) {
    take_in();
    if (cell_.bytes_in(id).value_or(0) >= bytes_in) co_return true;
    const bool may_come = cell_.find_line(id) != nullptr && !is_closing_;
    if (!may_come || asio::steady_timer::clock_type::now() >= deadline) co_return false;
    waiting_.insert(&timer);
    co_await timer.async_wait(kAwait);
    waiting_.erase(&timer);
  }
}

// Whoever waits for bytes looks again.
void RobotPort::tell() {
  for (asio::steady_timer* timer : waiting_) timer->cancel();
  acted_();
}

void RobotPort::close() {
  is_closing_ = true;
  listener_.close();
  for (const auto& [id, session] : sessions()) session->finish();
  tell();
}

void RobotPort::abort() {
  for (const auto& [id, session] : sessions()) session->close(CloseReason::kShutdown);
}

}  // namespace xr3
