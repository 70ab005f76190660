// The byte clock: simulated time moves with the bytes of the lines alone, a character for each and
// a fixed time before each inquiry, so that the replies are a function of the bytes. It holds the
// rules and what is left of a tick; the cell advances the machine. See docs/byte-clock.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/command.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/line/byte_clock_settings.hpp"
#include "protocol/line/line_speed.hpp"

namespace xr3 {

/// The settings of a line whose speed nobody has set: 9600 baud, 7 data bits, even parity, 2 stop
/// bits.
SerialSettings usual_line_settings();

class ByteClock {
 public:
  /// `speed` sets the time of a character; nullopt: usual_line_settings().
  explicit ByteClock(const ByteClockSettings& settings, const std::optional<LineSpeed>& speed = {});

  const ByteClockSettings& settings() const { return settings_; }
  /// The speed that gives characters their time.
  LineSpeed speed() const { return {fixed_, factor_}; }
  Micros inquiry_time() const { return settings_.inquiry_ms * kMicrosPerMs; }
  /// Whether the client of a line sets the time of its characters.
  bool follows_clients() const { return !fixed_; }
  /// The settings that give a line's characters their time. `of_client`: those of its port.
  SerialSettings settings_of(const std::optional<SerialSettings>& of_client) const;
  /// The time of a character on that line, rounded to microseconds.
  Micros character_time(const std::optional<SerialSettings>& of_client) const;

  /// Whole ticks of the remainder and `time`, which is not negative; what is left is the new
  /// remainder.
  Tick take_ticks(Micros time);
  /// 0...999.
  Micros remainder() const { return remainder_; }
  /// Precondition: 0...999.
  void set_remainder(Micros remainder);

  /// Replies have left whose time has not passed yet.
  void owe(Micros time) { owed_ += time; }
  /// Removes and returns that time.
  Micros take_owed() { return std::exchange(owed_, 0); }

  /// Notes a command that is about to be executed in this state. Returns whether it is the first of
  /// a run of motion commands that do not wait for the motion before: the joint still has counts to
  /// make, and no inquiry has come since its last motion command. An inquiry ends the run.
  bool note_command(const Command& command, const Model& model, const State& state);

  /// A new epoch: nothing is owed, and the remainder is 0.
  void restart();

  bool operator==(const ByteClock&) const = default;

 private:
  static constexpr Micros kMicrosPerMs = 1'000;

  bool is_hurried(char label, const Model& model, const State& state);

  ByteClockSettings settings_;
  Rate factor_;
  std::optional<SerialSettings> fixed_;
  Micros fixed_time_;
  Micros remainder_ = 0;
  Micros owed_ = 0;
  std::uint32_t commanded_ = 0;  ///< bit i: motor i has had a motion command since the last inquiry
  bool is_reported_ = false;     ///< the run of hurried commands
};

/// Parses `bytes` or `bytes:INQUIRY_MS[,settle=MS]`. Throws std::invalid_argument, with the allowed
/// form. Precondition: the text is `bytes`, or begins with `bytes:`.
ByteClockSettings parse_byte_clock(const std::string& text);

/// Whether a motor of this model is so slow that two inquiries in a row may find the same count
/// although it moves: a program that compares them takes it for stuck.
bool is_quicker_than_a_count(const ByteClock& clock, const Model& model);

}  // namespace xr3
