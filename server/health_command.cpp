#include "server/health_command.hpp"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>
#include <utility>

#include "protocol/health_probe.hpp"
#include "server/data_files.hpp"
#include "server/listener.hpp"
#include "server/monitor_socket.hpp"
#include "server/port_file.hpp"

namespace xr3 {
namespace {

using Clock = std::chrono::steady_clock;
using Verdict = HealthProbe::Verdict;

/// One connection takes no longer than this.
constexpr std::chrono::seconds kMostPatience{2};
/// Nobody tells us when a port is opened or a file written.
constexpr std::chrono::milliseconds kBeforeNextTry{20};

/// One connection, as far as it has come.
struct Visit {
  enum class Stage : std::uint8_t { kConnecting, kRefused, kTalking };
  Stage stage = Stage::kConnecting;
  std::string refusal;  ///< the system's words
  HealthProbe probe;
};

asio::awaitable<void> visit(asio::io_context& context, tcp::endpoint place, Visit& visit) {
  tcp::socket connecting(context);
  const auto [refused] = co_await connecting.async_connect(place, kAwait);
  visit.stage = refused ? Visit::Stage::kRefused : Visit::Stage::kTalking;
  visit.refusal = refused.message();
  if (refused) co_return;
  ErrorCode ignored;
  connecting.non_blocking(true, ignored);
  MonitorSocket socket(std::move(connecting));
  std::string to_send = HealthProbe::opening();
  while (visit.probe.verdict() == Verdict::kUnknown) {
    const bool is_sent = co_await socket.send(to_send);
    if (!is_sent) break;
    const std::string_view bytes = co_await socket.read();
    if (bytes.empty()) break;
    to_send = visit.probe.take(bytes);
  }
}

std::string trouble_of(const Visit& visit, const tcp::endpoint& place) {
  const std::string who = to_text(place);
  if (visit.probe.verdict() == Verdict::kHealthy) return {};
  if (visit.stage == Visit::Stage::kConnecting) return who + " does not answer: timed out";
  if (visit.stage == Visit::Stage::kRefused)
    return "nobody listens at " + who + " (" + visit.refusal + ")";
  return who + " " + visit.probe.trouble();
}

/// One try. Nothing: it is healthy; otherwise what came instead.
std::string ask(const tcp::endpoint& place, Clock::time_point deadline) {
  Visit result;
  asio::io_context context;
  asio::co_spawn(context, visit(context, place, result), asio::detached);
  context.run_until(deadline);
  return trouble_of(result, place);
}

/// What came instead of a good answer, or nothing, and what this is called.
struct Outcome {
  std::string trouble;
  ExitCode code = ExitCode::kNoServer;
};

/// A port file that is not there may be to come with its server; one that names no port is wrong.
Outcome try_once(const HealthOptions& options, Clock::time_point deadline) {
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

ExitCode fail(const Outcome& outcome) {
  std::cerr << "xr3: " << outcome.trouble << "\n";
  return outcome.code;
}

}  // namespace

ExitCode check_health(const HealthOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);
  const bool is_one_try = options.wait_s == 0;
  const auto wait =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.wait_s));
  const auto deadline = Clock::now() + (is_one_try ? kMostPatience : wait);
  for (;;) {
    const Outcome outcome = try_once(options, std::min(deadline, Clock::now() + kMostPatience));
    if (outcome.trouble.empty()) return ExitCode::kGood;
    // (twice, so that the last try has some time itself)
    if (is_one_try || Clock::now() + 2 * kBeforeNextTry > deadline) return fail(outcome);
    std::this_thread::sleep_for(kBeforeNextTry);
  }
}

}  // namespace xr3
