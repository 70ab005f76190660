#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "protocol/monitor/health_probe.hpp"
#include "server/files/data_files.hpp"
#include "server/files/port_file.hpp"
#include "server/net/listener.hpp"
#include "server/net/socket.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

using Clock = std::chrono::steady_clock;

/// Maximum time of one attempt.
constexpr std::chrono::seconds kMaxTry{2};
/// Polling interval: there is no notification of an opened port or a written file.
constexpr std::chrono::milliseconds kBetweenTries{20};

/// The progress of one attempt.
struct Visit {
  enum class VisitStage : std::uint8_t { kConnecting, kRefused, kTalking };
  VisitStage stage = VisitStage::kConnecting;
  std::string refusal;  ///< the system's error message
  HealthProbe probe;
  std::string readiness;  ///< the response of /readyz
};

/// Whether the monitor port has answered as required, so that /readyz decides.
bool has_answered(const HealthProbe& probe) {
  return probe.health() == HealthProbe::Health::kHealthy ||
         probe.health() == HealthProbe::Health::kFull;
}

/// Connects; nullptr if refused.
asio::awaitable<std::unique_ptr<MonitorSocket>> connect(asio::io_context& context,
                                                        const tcp::endpoint& place, Visit& visit) {
  tcp::socket connecting(context);
  visit.stage = Visit::VisitStage::kConnecting;
  const auto [refused] = co_await connecting.async_connect(place, kAwait);
  visit.stage = refused ? Visit::VisitStage::kRefused : Visit::VisitStage::kTalking;
  visit.refusal = refused.message();
  if (refused) co_return nullptr;
  ErrorCode ignored;
  connecting.non_blocking(true, ignored);
  co_return std::make_unique<MonitorSocket>(std::move(connecting));
}

/// Receives `hello` and the answer to a ping.
asio::awaitable<void> greet(MonitorSocket& socket, HealthProbe& probe) {
  std::string to_send = HealthProbe::opening();
  while (probe.health() == HealthProbe::Health::kUnknown) {
    const bool is_sent = co_await socket.send(to_send);
    if (!is_sent) break;
    const std::string_view bytes = co_await socket.read();
    if (bytes.empty()) break;
    to_send = probe.feed(bytes);
  }
}

/// Requests /readyz. Returns the response.
asio::awaitable<std::string> ask_ready(MonitorSocket& socket, const tcp::endpoint& place) {
  std::string answer;
  const std::string request = ready_request(to_text(place));
  const bool is_sent = co_await socket.send(request);
  ErrorCode ignored;
  socket.stream().shutdown(tcp::socket::shutdown_send, ignored);
  while (is_sent && answer.size() < HealthProbe::kMaxLineBytes) {
    const std::string_view bytes = co_await socket.read();
    if (bytes.empty()) break;
    answer += bytes;
  }
  co_return answer;
}

asio::awaitable<void> visit(asio::io_context& context, tcp::endpoint place, Visit& visit) {
  auto socket = co_await connect(context, place, visit);
  if (!socket) co_return;
  co_await greet(*socket, visit.probe);
  if (!has_answered(visit.probe)) co_return;
  socket = co_await connect(context, place, visit);
  if (socket) visit.readiness = co_await ask_ready(*socket, place);
}

std::string trouble_of(const Visit& visit, const tcp::endpoint& place) {
  const std::string who = to_text(place);
  if (visit.stage == Visit::VisitStage::kConnecting) return who + " does not answer: timed out";
  if (visit.stage == Visit::VisitStage::kRefused)
    return "cannot connect to " + who + " (" + visit.refusal + ")";
  if (!has_answered(visit.probe)) return who + " " + visit.probe.trouble();
  const std::string trouble = trouble_with_readiness(visit.readiness);
  return trouble.empty() ? trouble : who + " " + trouble;
}

/// One attempt. Returns the problem, or empty if the server is healthy.
std::string ask(const tcp::endpoint& place, Clock::time_point deadline) {
  Visit result;
  asio::io_context context;
  spawn_loop(context.get_executor(), "healthcheck", visit(context, place, result));
  context.run_until(deadline);
  return trouble_of(result, place);
}

/// The result of an attempt: the problem, empty if there is none, and its exit code.
struct AttemptResult {
  std::string trouble;
  ExitCode code = ExitCode::kNoServer;
};

/// Makes one attempt. A missing port file may still be written by its server; one without a port is
/// invalid.
AttemptResult try_once(const HealthOptions& options, Clock::time_point deadline) {
  const auto address = asio::ip::make_address(address_to_ask(options.listen));
  try {
    const bool has_file = !options.port_file.empty();
    const auto port = has_file ? read_monitor_port(options.port_file) : options.monitor_port;
    return {ask({address, port}, deadline)};
  } catch (const FileError& error) {
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(options.port_file, ignored);
    return {error.what(), is_there ? ExitCode::kBadInput : ExitCode::kNoServer};
  }
}

}  // namespace

ExitCode run_command(const HealthOptions& options) {
  ignore_signals_of_writing();
  const bool is_one_try = options.wait_s == 0;
  const auto wait =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.wait_s));
  const auto deadline = Clock::now() + (is_one_try ? kMaxTry : wait);
  for (;;) {
    const AttemptResult outcome = try_once(options, std::min(deadline, Clock::now() + kMaxTry));
    if (outcome.trouble.empty()) return ExitCode::kGood;
    // (twice, to leave some time for the last attempt)
    if (is_one_try || Clock::now() + 2 * kBetweenTries > deadline)
      return fail(outcome.code, outcome.trouble);
    std::this_thread::sleep_for(kBetweenTries);
  }
}

}  // namespace xr3
