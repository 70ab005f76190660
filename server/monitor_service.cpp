#include "server/monitor_service.hpp"

#include <chrono>
#include <utility>

#include "protocol/snapshot_json.hpp"
#include "server/wall_clock.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;

bool moves_time(const call::Call& call) {
  return std::holds_alternative<call::Step>(call) || std::holds_alternative<call::RunUntil>(call);
}

monitor::RequestError no_such_line(LineId line) {
  return {{},
          "no_such_line",
          "line " + std::to_string(line) + " is not open",
          "lines are numbered from 1 as they are opened",
          {}};
}

monitor::RequestError timeout(const monitor::After& after, std::uint64_t bytes_in) {
  const std::string message = "line " + std::to_string(after.line) + " has received " +
                              std::to_string(bytes_in) + " of " + std::to_string(after.bytes_in) +
                              " bytes after " + std::to_string(after.within_ms) + " ms";
  return {{},
          "timeout",
          message,
          "nothing was changed; send the bytes, or allow more time by within_ms",
          {}};
}

monitor::RequestError refused_error(const monitor::RequestId& id, const call::Refused& refused) {
  return {id, refused.code, refused.message, refused.hint, {}};
}

}  // namespace

std::int64_t StateSequence::number_of(const Snapshot& snapshot) {
  if (last_ != snapshot) {
    last_ = snapshot;
    ++seq_;
  }
  return seq_;
}

monitor::Message MonitorService::hello() {
  cell_.catch_up(wall_now());
  const Snapshot now = snapshot();
  return monitor::hello({"xr3 " XR3_VERSION, cells(), cell_.model(), now});
}

asio::awaitable<monitor::Message> MonitorService::answer(monitor::Request request) {
  if (std::holds_alternative<monitor::Ping>(request.what)) co_return monitor::pong(request.id);
  if (const auto* get = std::get_if<monitor::Get>(&request.what))
    co_return show_state(request, *get);
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const bool in_standing_time = cell_.clock().mode() == ClockMode::kManual;
  if (wanted.after && in_standing_time) {  // running time is refused without waiting
    auto error = co_await wait_for(*wanted.after);
    if (error) {
      error->id = request.id;
      co_return monitor::result(*error);
    }
  }
  co_return carry_out(request);
}

monitor::Message MonitorService::show_state(const monitor::Request& request,
                                            const monitor::Get& get) {
  cell_.catch_up(wall_now());
  const Snapshot now = snapshot();
  const Json members = chosen(state_json(cell_.model(), now), get.fields);
  return monitor::state(
      request.id, {request.cell, now.epoch, sequence_.number_of(now), now.state.tick}, members);
}

asio::awaitable<std::optional<monitor::RequestError>> MonitorService::wait_for(
    monitor::After after) {
  robot_port_.take_in();
  if (!cell_.bytes_in(after.line)) co_return no_such_line(after.line);
  const bool arrived = co_await robot_port_.wait_for_bytes(after.line, after.bytes_in,
                                                           milliseconds(after.within_ms));
  if (arrived) co_return std::nullopt;
  if (cell_.find_line(after.line) == nullptr) co_return no_such_line(after.line);
  co_return timeout(after, cell_.bytes_in(after.line).value_or(0));
}

// Nothing suspends between taking in the bytes that have arrived and the call that must follow
// them.
monitor::Message MonitorService::carry_out(monitor::Request& request) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  if (moves_time(wanted.call)) robot_port_.take_in();
  if (const auto error = monitor::fit(request, cell_.state().tick)) return monitor::result(*error);
  const Applied applied = cell_.apply(wanted.call, wall_now());
  acted_();
  if (const auto* refused = std::get_if<call::Refused>(&applied.outcome)) {
    return monitor::result(refused_error(request.id, *refused));
  }
  return done(request, std::get<call::Done>(applied.outcome));
}

monitor::Message MonitorService::done(const monitor::Request& request, const call::Done& done) {
  const auto& wanted = std::get<monitor::CallRequest>(request.what);
  const Snapshot now = snapshot();
  Json value = {{"epoch", now.epoch}, {"tick", now.state.tick}};
  if (done.reached) value["reached"] = *done.reached;
  if (done.ran_ticks) value["ran_ticks"] = *done.ran_ticks;
  if (moves_time(wanted.call))
    value["state"] = chosen(state_json(cell_.model(), now), wanted.fields);
  return monitor::result(request.id, value);
}

Snapshot MonitorService::snapshot() const {
  const SimClock& clock = cell_.clock();
  return {cell_.epoch(), clock.mode(), clock.rate(), 1, cell_.state()};
}

}  // namespace xr3
