// The part of a serial line that gives bytes their time.
#include <cassert>
#include <utility>

#include "cell/serial_line.hpp"

namespace xr3 {

void SerialLine::set_speed(const LineSpeed& speed) {
  assert(bytes_in_ == 0 && device_ == nullptr);
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

bool SerialLine::set_settings(const SerialSettings& settings, bool is_cooked) {
  settings_ = settings;
  if (speed_) update_pace();
  const bool was_cooked = std::exchange(is_cooked_, is_cooked_ || is_cooked);
  return is_cooked_ && !was_cooked;
}

/// While the client does not read its replies, its bytes do not act.
void SerialLine::update_input_halt(Micros now) {
  if (pace_) pace_->halt(Direction::kIn, is_full() || pace_->are_replies_full(), now);
}

void SerialLine::act_due(Micros now, Simulation& simulation, std::vector<Exchange>& exchanges) {
  released_.clear();
  const ReceivedByte next = pace_->take_input();
  acted_.add(next.offset, std::string(1, static_cast<char>(next.byte)));
  act_on(next.byte, next.offset, {simulation, exchanges, now});
  update_input_halt(now);
}

void SerialLine::send_due(Micros now) {
  released_.clear();
  const ReplyByte next = pace_->take_reply_byte();
  const std::uint64_t from = output_end();
  if (next.is_first) reply_from_ = from;
  send({&next.byte, 1});
  departed_.add(from, outbox().substr(from - bytes_out_));
  if (next.meaning) released_.push_back({reply_from_, output_end(), *next.meaning});
  update_input_halt(now);
}

std::size_t SerialLine::held_bytes() const {
  const std::size_t under_way =
      pace_ ? pace_->input_bytes() * sizeof(ReceivedByte) + pace_->reply_bytes() : 0;
  return hold_.size() + under_way + (faults_ ? faults_->held_bytes() : 0);
}

}  // namespace xr3
