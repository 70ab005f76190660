#include "cell/byte_clock.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/motor.hpp"
#include "protocol/text/whole_number.hpp"

namespace xr3 {
namespace {

constexpr Micros kMicrosPerSecond = 1'000'000;

/// The label of the joint that the command moves or stops; 0: none.
char moved_joint(const Command& command) {
  if (const auto* move = std::get_if<Move>(&command)) return move->label;
  if (const auto* stop = std::get_if<Stop>(&command)) return stop->label;
  return 0;
}

}  // namespace

SerialSettings usual_line_settings() { return {kDefaultBaud, SerialFrame{}}; }

ByteClock::ByteClock(const ByteClockSettings& settings, const std::optional<LineSpeed>& speed)
    : settings_(settings),
      factor_(speed ? speed->factor : Rate{}),
      fixed_(speed ? speed->settings : usual_line_settings()),
      fixed_time_(CharacterTime(fixed_.value_or(usual_line_settings()), factor_).rounded()) {
  assert(settings.inquiry_ms >= 0 && settings.inquiry_ms <= ByteClockSettings::kMaxInquiryMs);
}

SerialSettings ByteClock::settings_of(const std::optional<SerialSettings>& of_client) const {
  return fixed_ ? *fixed_ : of_client.value_or(usual_line_settings());
}

Micros ByteClock::character_time(const std::optional<SerialSettings>& of_client) const {
  if (fixed_ || !of_client) return fixed_time_;
  return CharacterTime(*of_client, factor_).rounded();
}

Tick ByteClock::take_ticks(Micros time) {
  assert(time >= 0);
  const Micros all = remainder_ + time;
  remainder_ = all % kMicrosPerTick;
  return all / kMicrosPerTick;
}

void ByteClock::set_remainder(Micros remainder) {
  assert(remainder >= 0 && remainder < kMicrosPerTick);
  remainder_ = remainder;
}

bool ByteClock::note_command(const Command& command, const Model& model, const State& state) {
  if (is_inquiry(command)) {
    commanded_ = 0;
    is_reported_ = false;
    return false;
  }
  const char label = moved_joint(command);
  if (label == 0 || !is_hurried(label, model, state)) return false;
  return !std::exchange(is_reported_, true);
}

bool ByteClock::is_hurried(char label, const Model& model, const State& state) {
  const int index = model.index_of(label);
  if (index < 0 || state.stall != Stall::kNo) return false;
  const std::uint32_t bit = 1U << static_cast<unsigned>(index);
  const bool was_commanded = (std::exchange(commanded_, commanded_ | bit) & bit) != 0;
  return was_commanded && is_running(state.motor(index));
}

void ByteClock::restart() {
  remainder_ = owed_ = 0;
  commanded_ = 0;
  is_reported_ = false;
}

ByteClockSettings parse_byte_clock(const std::string& text) {
  constexpr std::string_view kName = "bytes";
  ByteClockSettings settings;
  if (text == kName) return settings;
  constexpr std::string_view kSettle = "settle=";
  using Limits = ByteClockSettings;
  const std::string_view rules = std::string_view(text).substr(kName.size() + 1);
  const std::size_t comma = rules.find(',');
  const auto inquiry = whole_number<std::int64_t>(rules.substr(0, comma), 0, Limits::kMaxInquiryMs);
  bool is_good = inquiry.has_value();
  if (comma != std::string_view::npos) {
    const std::string_view rest = rules.substr(comma + 1);
    if (rest.starts_with(kSettle))
      settings.settle_ms = whole_number<std::int64_t>(rest.substr(kSettle.size()),
                                                      Limits::kMinSettleMs, Limits::kMaxSettleMs);
    is_good = is_good && settings.settle_ms;
  }
  if (!is_good) {
    throw std::invalid_argument(
        text + ": the byte clock is bytes:INQUIRY_MS, 0..." +
        std::to_string(Limits::kMaxInquiryMs) + ", or bytes:INQUIRY_MS,settle=MS, " +
        std::to_string(Limits::kMinSettleMs) + "..." + std::to_string(Limits::kMaxSettleMs));
  }
  settings.inquiry_ms = *inquiry;
  return settings;
}

bool is_quicker_than_a_count(const ByteClock& clock, const Model& model) {
  constexpr int kCharactersOfAPoll = 3;  // such as E? and its reply
  const Micros poll =
      clock.inquiry_time() + kCharactersOfAPoll * clock.character_time(std::nullopt);
  Micros longest = 0;
  for (int i = 0; i < model.motor_count(); ++i)
    longest = std::max(longest, kMicrosPerSecond / model.motor(i).drive.speed_counts_per_s);
  return poll < longest;
}

}  // namespace xr3
