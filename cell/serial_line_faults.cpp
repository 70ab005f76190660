// The part of a serial line that faults on demand act on.
#include <utility>

#include "cell/serial_line.hpp"

namespace xr3 {

/// Lets faults act on a byte of data: what arrives at the controller is interpreted.
void SerialLine::act_on_faulty(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  for (const char each : faults_->receive(byte, effects.simulation))
    interpret(static_cast<std::uint8_t>(each), offset, effects);
  if (is_cut()) drop_input();
}

/// Lets faults act on a reply. Returns whether it leaves now; if not, it is lost or waits.
bool SerialLine::leaves_now(std::string& reply, const Exchange& exchange, const Effects& effects) {
  if (faults_->passes_reply(effects.simulation.state(), reply.size())) return true;
  Carried carried = faults_->carry(reply, effects.simulation);
  reply = std::move(carried.bytes);
  if (reply.empty()) return false;
  if (carried.has_parity_error) telnet_.report_parity_error(outbox_);
  const State& state = effects.simulation.state();
  if (!faults_->must_wait(state, carried.delay_ms)) return true;
  faults_->add(state, carried.delay_ms, {0, std::move(reply), answer_of(exchange)});
  return false;
}

std::optional<Micros> SerialLine::next_reply(const State& state) const {
  const std::optional<Micros> of_pace = due(Direction::kOut);
  const std::optional<Tick> released = faults_ ? faults_->due(state) : std::nullopt;
  if (!released) return of_pace;
  const Micros moment = micros_at(*released);
  return of_pace ? std::min(*of_pace, moment) : moment;
}

bool SerialLine::is_reply_released(const State& state) const {
  const std::optional<Tick> released = faults_ ? faults_->due(state) : std::nullopt;
  return released && *released <= state.tick;
}

void SerialLine::release_replies(const State& state, Micros now) {
  released_.clear();
  while (const auto reply = faults_->take_due(state)) leave(*reply, now);
}

void SerialLine::leave(const DelayedReply& reply, Micros now) {
  if (pace_) return pace_->add_reply(reply.bytes, reply.meaning, now);
  if (hold_.is_on()) return hold_.add(reply.bytes, reply.meaning);
  const std::uint64_t from = output_end();
  send(reply.bytes);
  released_.push_back({from, output_end(), reply.meaning});
}

void SerialLine::cut() {
  if (!faults_) return;
  faults_->cut();
  drop_input();
}

}  // namespace xr3
