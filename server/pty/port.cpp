#include "server/pty/port.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <cassert>
#include <memory>
#include <utility>

#include "cell/failure.hpp"
#include "server/pty/stream.hpp"

namespace xr3 {
namespace {

constexpr const char* kPtyName = "the pseudo-terminals";

// Maximum number of rounds of a barrier. A pseudo-terminal holds at most 22 KiB, of which a round
// moves 4095 bytes; the end of a line and the start of the next take one each. More only come from
// programs that go on meanwhile.
constexpr int kMaxRounds = 13;

}  // namespace

PtyPort::PtyPort(asio::io_context& io, LineSessions& lines)
    : io_(io), lines_(lines), round_ended_(io, asio::steady_timer::time_point::max()) {}

void PtyPort::serve(const std::vector<std::string>& paths, ::mode_t rights) {
  assert(terminals_.empty());
  const auto notify = [this] { asio::post(io_, [this] { notice(); }); };
  for (const std::string& path : paths) terminals_.emplace_back(path, rights, notify);
  lines_.add(*this);
}

void PtyPort::close() {
  is_closing_ = true;
  for (ServedTerminal& terminal : terminals_) terminal.pump.close();
  round_ended_.cancel();
}

void PtyPort::notice() {
  fatal_if_throws(kPtyName, [this] {
    round_ended_.cancel();
    if (is_closing_) return;
    accept_arrived();
    for (ServedTerminal& terminal : terminals_) report(terminal);
  });
}

// Until a round brings nothing more: the kernel hands on at most 4095 bytes at once, and a program
// may have come right after another one.
asio::awaitable<void> PtyPort::settle() {
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::uint64_t before = progress_;
    co_await run_round();
    co_await lines_.read_lines_of(*this);
    if (progress_ == before) co_return;
  }
}

asio::awaitable<void> PtyPort::run_round() {
  std::vector<std::pair<PtyShared*, std::uint64_t>> rounds;
  for (ServedTerminal& each : terminals_)
    rounds.emplace_back(&each.pump.shared(), each.pump.begin_round());
  const auto has_ended = [](PtyShared& shared, std::uint64_t round) {
    const std::scoped_lock use(shared.use);
    return shared.rounds_ended >= round;
  };
  for (const auto& [shared, round] : rounds)
    while (!is_closing_ && !has_ended(*shared, round)) co_await round_ended_.async_wait(kAwait);
}

void PtyPort::accept_arrived() {
  for (ServedTerminal& terminal : terminals_) accept(terminal.pump);
}

// If the line is refused, the thread sees the end of its socket pair.
void PtyPort::accept(PtyPump& pump) {
  if (is_closing_) return;
  Descriptor line;
  {
    const std::scoped_lock use(pump.shared().use);
    line = std::exchange(pump.shared().line, Descriptor());
  }
  if (!line.is_open()) return;
  ++progress_;
  lines_.open(*this, std::make_unique<PtyStream>(std::move(line), pump.shared(), progress_),
              LineOpened{pump.path(), LineKind::kPty});
}

void PtyPort::report(ServedTerminal& terminal) {
  PtyShared& shared = terminal.pump.shared();
  const std::scoped_lock use(shared.use);
  const bool has_failed = shared.failure != nullptr;
  if (has_failed == std::exchange(terminal.has_failed, has_failed)) return;
  const std::string& path = terminal.pump.path();
  if (!has_failed) return spdlog::info("{}: the pseudo-terminal is served again", path);
  try {
    std::rethrow_exception(shared.failure);
  } catch (const std::exception& error) {
    spdlog::error("{}: {}; it is tried again every second", path, error.what());
  }
}

}  // namespace xr3
