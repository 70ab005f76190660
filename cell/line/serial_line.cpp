#include "cell/line/serial_line.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace xr3 {

// --- In.

std::string SerialLine::detect(std::uint8_t byte) {
  ++bytes_in_;
  const bool is_detected = is_network() && guard_ != Guard::kOff;
  const Detection detection = is_detected ? detector_.feed(byte) : Detection::kPass;
  is_not_a_robot_program_ = detection == Detection::kNotARobotProgram;
  if (detection != Detection::kPass) return {};
  std::string passed;
  if (!detector_.held().empty()) passed = detector_.release();
  passed.push_back(static_cast<char>(byte));
  return passed;
}

TelnetInput SerialLine::filter(std::uint8_t byte) {
  const TelnetInput input = telnet_.feed(byte, outbox_.end_bytes());
  if (!input.data && speed_) update_pace();
  return input;
}

bool SerialLine::delays(const ReceivedByte& byte, Micros now) {
  if (!pace_) return false;
  pace_->add_input(byte, now);
  return true;
}

ReceivedByte SerialLine::take_due() {
  const ReceivedByte next = pace_->take_input();
  acted_.add(next.offset, std::string(1, static_cast<char>(next.byte)));
  return next;
}

void SerialLine::drop_unfinished(std::uint64_t switches) {
  if (std::exchange(seen_switches_, switches) == switches) return;
  endpoint_.reset();
  device_parser_ = RhinoParser(Profile::kMark3);
}

void SerialLine::cut() {
  if (!faults_) return;
  faults_->cut();
  drop_input();
}

// --- Out.

bool SerialLine::keeps(std::string_view reply, const wire::Meaning& meaning, Micros now) {
  if (pace_) {
    pace_->add_reply(reply, meaning, now);
  } else if (hold_.is_on()) {
    hold_.add(reply, meaning);
  }
  return pace_ || hold_.is_on();
}

wire::Item SerialLine::send(std::string_view reply, const wire::Meaning& meaning) {
  const std::uint64_t from = output_end();
  telnet_.encode(reply, outbox_.end_bytes());
  return {from, output_end(), meaning};
}

std::optional<wire::Item> SerialLine::send_due(char& left) {
  const ReplyByte next = pace_->take_reply_byte();
  left = next.byte;
  const std::uint64_t from = output_end();
  if (next.is_first) reply_from_ = from;
  telnet_.encode({&next.byte, 1}, outbox_.end_bytes());
  departed_.add(from, outbox().substr(from - bytes_out()));
  if (!next.meaning) return std::nullopt;
  return wire::Item{reply_from_, output_end(), *next.meaning};
}

void SerialLine::suspend(Micros now) {
  if (has_input_ended_) return;
  pace_ ? pace_->halt(Direction::kOut, true, now) : hold_.begin();
}

HeldReplies SerialLine::resume(Micros now) {
  if (!pace_) return hold_.end();
  pace_->halt(Direction::kOut, false, now);
  return {};
}

void SerialLine::drop_replies(Micros now) {
  hold_.discard();
  if (faults_) faults_->discard();
  if (!pace_) return;
  pace_->discard_replies();
  update_input_halt(now);
}

std::optional<Micros> SerialLine::next_reply(const State& state) const {
  const std::optional<Micros> of_pace = due(Direction::kOut);
  const std::optional<Tick> released = faults_ ? faults_->due(state) : std::nullopt;
  if (!released) return of_pace;
  const Micros moment = micros_at(*released);
  return of_pace ? std::min(*of_pace, moment) : moment;
}

void SerialLine::sent(std::size_t count, Micros now) {
  outbox_.sent(count);
  update_input_halt(now);
}

// --- The speed of the port.

void SerialLine::set_speed(const LineSpeed& speed) {
  assert(bytes_in_ == 0);
  speed_ = speed;
  update_pace();
}

std::optional<SerialSettings> SerialLine::speed() const {
  if (!speed_) return std::nullopt;
  return speed_->settings ? speed_->settings : settings();
}

/// Sets the time of characters from the speed of the line or, with `auto`, of its client.
void SerialLine::update_pace() {
  const std::optional<SerialSettings> known = speed();
  if (!known) return;
  const CharacterTime time(*known, speed_->factor);
  pace_ ? pace_->set_time(time) : void(pace_.emplace(time));
}

void SerialLine::restart(Micros now) {
  if (pace_) pace_->restart(now);
  if (faults_) faults_->restart(first_tick_after(now));
}

// --- The client.

bool SerialLine::set_settings(const SerialSettings& settings, bool is_cooked) {
  settings_ = settings;
  if (speed_) update_pace();
  const bool was_cooked = std::exchange(is_cooked_, is_cooked_ || is_cooked);
  return is_cooked_ && !was_cooked;
}

LineKind SerialLine::kind() const {
  if (telnet_.has_com_port()) return LineKind::kRfc2217;
  return telnet_.is_telnet() ? LineKind::kTelnet : kind_;
}

std::size_t SerialLine::held_bytes() const {
  const std::size_t under_way =
      pace_ ? pace_->input_bytes() * sizeof(ReceivedByte) + pace_->reply_bytes() : 0;
  return hold_.size() + under_way + (faults_ ? faults_->held_bytes() : 0);
}

void SerialLine::write_state(StateWriter& out) const {
  out.add(kind_, guard_, detector_, is_not_a_robot_program_, telnet_, endpoint_.parser(),
          device_parser_, seen_switches_, faults_, hold_, pace_, has_input_ended_, is_cooked_,
          settings_ ? text_of(*settings_) : "", bytes_in_, output_end());
}

}  // namespace xr3
