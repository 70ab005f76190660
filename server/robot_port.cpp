#include "server/robot_port.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <utility>

#include "server/wall_clock.hpp"

namespace xr3 {

RobotPort::RobotPort(asio::io_context& io, Cell& cell, std::size_t most_lines,
                     std::function<void()> acted)
    : io_(io),
      cell_(cell),
      most_lines_(most_lines),
      acted_(std::move(acted)),
      context_{cell, scratch_, [this] { tell(); }, [this](LineId line) { end(line); }},
      listener_(io, [this](tcp::socket socket) { open(std::move(socket)); }),
      watch_(io) {}

ErrorCode RobotPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void RobotPort::open(tcp::socket socket) {
  if (sessions_.size() >= most_lines_) {
    if (!std::exchange(has_told_of_full_, true)) {
      spdlog::warn("lines are refused: {} are open already (--max-lines; told once until one ends)",
                   sessions_.size());
    }
    return;  // closed without a byte
  }
  const auto session = std::make_shared<RobotSession>(std::move(socket), context_);
  sessions_.emplace(session->line(), session);
  if (!watch_.add(session->descriptor(), session->line()))
    return session->close(CloseReason::kError);
  if (!std::exchange(is_watching_, true)) asio::co_spawn(io_, run(), asio::detached);
  tell();
}

void RobotPort::end(LineId line) {
  sessions_.erase(line);
  unfinished_.erase(line);
  has_told_of_full_ = false;
  if (is_closing_ && sessions_.empty()) watch_.close();
  tell();
}

bool RobotPort::disconnect(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return false;
  const auto session = found->second;  // it takes itself out of the map
  session->close(CloseReason::kDisconnected);
  return true;
}

// --- Turns.

asio::awaitable<void> RobotPort::run() {
  for (bool has_news = true; has_news;) {
    has_news = co_await watch_.wait();
    if (has_news) take_turns();
  }
}

void RobotPort::take_turns() {
  for (const LineId line : std::exchange(unfinished_, {})) take_turn(line);
  for (const auto& [line, is_end] : watch_.news()) {
    const auto found = sessions_.find(line);
    if (found != sessions_.end() && is_end) found->second->note_end();
    take_turn(line);
  }
  if (!unfinished_.empty()) take_turns_again();
}

void RobotPort::take_turn(LineId line) {
  const auto found = sessions_.find(line);
  if (found == sessions_.end()) return;
  const auto session = found->second;  // it may take itself out of the map
  if (session->take_turn()) unfinished_.insert(line);
}

// Behind whatever else is ready now.
void RobotPort::take_turns_again() {
  if (std::exchange(is_again_, true)) return;
  asio::post(io_, [this] {
    is_again_ = false;
    take_turns();
  });
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
  if (sessions_.empty()) watch_.close();
  tell();
}

void RobotPort::abort() {
  for (const auto& [id, session] : sessions()) session->close(CloseReason::kShutdown);
}

}  // namespace xr3
