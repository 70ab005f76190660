#include "cell/line/faults.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3 {

std::string LineFaults::receive(std::uint8_t byte, Simulation& simulation) {
  assert(has_line_faults(simulation.state()));
  const std::uint64_t offset = received_++;
  const LinePlace place{line_, LineSide::kIn, offset};
  std::string bytes = offset == 0 ? simulation.stray_bytes(place) : "";
  const Carried carried = simulation.carry_input(place, byte);
  bytes += carried.bytes;
  if (carried.is_disconnected) cut();
  keep_events(simulation);
  return bytes;
}

Carried LineFaults::carry(std::string_view reply, Simulation& simulation) {
  const std::uint64_t offset = std::exchange(replied_, replied_ + reply.size());
  if (!has_line_faults(simulation.state())) return {std::string(reply)};
  const LinePlace place{line_, LineSide::kOut, offset};
  const std::string strays = offset == 0 ? simulation.stray_bytes(place) : "";
  Carried carried = simulation.carry_reply(place, reply);
  carried.bytes.insert(0, strays);
  keep_events(simulation);
  return carried;
}

void LineFaults::keep_events(Simulation& simulation) {
  if (simulation.events().empty()) return;
  Events events = simulation.take_events();
  events_.insert(events_.end(), std::make_move_iterator(events.begin()),
                 std::make_move_iterator(events.end()));
}

// --- Replies that wait.

bool LineFaults::must_wait(const State& state, std::uint32_t delay_ms) const {
  if (!waiting_.empty() || delay_ms > 0) return true;
  return has_line_faults(state) &&
         (xoff_end(state, line_) > state.tick || batch_tick(state, line_, state.tick) > state.tick);
}

void LineFaults::add(const State& state, std::uint32_t delay_ms, DelayedReply reply) {
  assert(must_wait(state, delay_ms));
  const Tick earliest = waiting_.empty() ? state.tick : std::max(state.tick, waiting_.back().due);
  reply.due = batch_tick(state, line_, std::max(earliest, state.tick + delay_ms));
  bytes_ += reply.bytes.size();
  waiting_.push_back(std::move(reply));
}

std::optional<Tick> LineFaults::due(const State& state) const {
  if (waiting_.empty()) return std::nullopt;
  const Tick tick = std::max(waiting_.front().due, xoff_end(state, line_));
  return tick <= Fault::kMaxTicks ? std::optional(tick) : std::nullopt;  // time ends before
}

std::optional<DelayedReply> LineFaults::take_due(const State& state) {
  const std::optional<Tick> tick = due(state);
  if (!tick || *tick > state.tick) return std::nullopt;
  DelayedReply reply = std::move(waiting_.front());
  waiting_.pop_front();
  bytes_ -= reply.bytes.size();
  return reply;
}

void LineFaults::discard() {
  waiting_.clear();
  bytes_ = 0;
}

void LineFaults::restart(Tick now) {
  for (DelayedReply& reply : waiting_) reply.due = now;
}

}  // namespace xr3
