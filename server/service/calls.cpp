#include "server/service/calls.hpp"

#include <chrono>
#include <string>

#include "service/answer.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

bool moves_time(const monitor::CallRequest& wanted) {
  const auto* call = std::get_if<call::Call>(&wanted.call);
  return call != nullptr && call::traits_of(*call).moves_time;
}

call::Refused timeout(const monitor::After& after, std::uint64_t bytes_in) {
  const std::string message = "line " + std::to_string(after.line) + " has received " +
                              std::to_string(bytes_in) + " of " + std::to_string(after.bytes_in) +
                              " bytes after " + std::to_string(after.within_ms) + " ms";
  return {"timeout", message,
          "nothing was changed; send the bytes, or allow more time by within_ms"};
}

call::Refused not_yours(const std::string& fn) {
  return {"not_yours", "the call " + fn + " needs the token of the server",
          "the token of one robot suffices for the other calls"};
}

/// Waits until a line has received bytes. Returns the error, or nullopt.
asio::awaitable<std::optional<call::Refused>> wait_for_bytes(HostedCell& at, monitor::After after) {
  const Cell& cell = at.cell();
  const bool arrived = co_await at.transports().wait_for_bytes(after.line, after.bytes_in,
                                                               milliseconds(after.within_ms));
  if (!cell.bytes_in(after.line)) co_return service::no_such_line(after.line);
  if (arrived) co_return std::nullopt;
  if (cell.find_line(after.line) == nullptr) co_return service::no_such_line(after.line);
  co_return timeout(after, cell.bytes_in(after.line).value_or(0));
}

}  // namespace

// With the real clock, a call that moves time is refused without waiting.
asio::awaitable<std::optional<call::Refused>> MonitorCalls::wait(CallOf of) {
  const bool in_real_clock = of.cell().clock().mode() == ClockMode::kReal;
  if (of.wanted.after && !in_real_clock) {
    std::optional<call::Refused> error = co_await wait_for_bytes(*of.at, *of.wanted.after);
    if (error) co_return error;
  }
  if (moves_time(of.wanted)) co_await of.at->transports().read_arrived();
  co_return std::nullopt;
}

MonitorCalls::Answer MonitorCalls::carry_out(CallOf of, const call::Call& call) {
  if (call::traits_of(call).is_for_teachers && of.session.access() != Access::kControl)
    co_return service::refused(of.id(), not_yours(of.wanted.fn));
  if (may_enlarge(call)) co_return service::carry_out(of.now(), call);
  co_return service::refused(of.id(), {"limit", "the server has allocated more than --max-memory",
                                       "remove blocks, or restart the server"});
}

/// One cell is bounded by its own limits; many together are bounded here.
bool MonitorCalls::may_enlarge(const call::Call& call) const {
  const bool is_bounded = memory_ != nullptr && !cells_.is_single();
  return !is_bounded || !call::traits_of(call).enlarges || !memory_->is_exceeded();
}

}  // namespace xr3
