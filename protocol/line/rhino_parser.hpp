// The incremental parser of the serial line. A command is emitted at its last byte; numbers end at
// the first byte that is not a digit; unknown bytes are skipped and reported. It follows the
// paper's Tables VI and VII and the Rhino Mark III. Independent of the machine, never throws. A
// value of a few dozen bytes.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "core/command.hpp"
#include "core/model.hpp"
#include "protocol/line/line_word.hpp"
#include "protocol/line/parsed.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

class RhinoParser {
 public:
  explicit RhinoParser(Profile profile) : profile_(profile) {}

  /// Handles the byte at `offset` of the line's input and appends the items that it completes: at
  /// most three, so memory stays bounded for any input.
  void feed(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out);

  /// Handles a byte like feed() while the controller is disabled: only `A@` is accepted, everything
  /// else is a problem.
  void feed_disabled(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out);

  bool operator==(const RhinoParser&) const = default;
  /// Without the word, which changes only warnings.
  void write_state(StateWriter& out) const {
    out.add(mode_, label_, opener_, skips_numbers_, list_is_bad_, list_size_, number_.sign,
            number_.digits, number_.ended, number_.modulo_256, number_.magnitude, list_, offset_,
            from_, to_, raw_.view());
  }

 private:
  enum class Mode : std::uint8_t { kIdle, kNumber, kOutput, kView, kCamera, kPeriod, kStatus };

  /// A decimal number being read: saturating, and modulo 256 for the mark3 profile.
  struct Number {
    char sign = 0;
    std::uint8_t digits = 0;
    bool ended = false;  ///< a blank followed its digits
    std::uint8_t modulo_256 = 0;
    std::int32_t magnitude = 0;

    void push(std::uint8_t digit);
    int value() const { return sign == '-' ? -magnitude : magnitude; }
    bool operator==(const Number&) const = default;
  };

  void feed_idle(std::uint8_t byte, std::vector<Parsed>& out);
  void feed_letter(std::uint8_t letter, std::uint8_t byte, std::vector<Parsed>& out);
  void feed_number_start(std::uint8_t byte, std::vector<Parsed>& out);
  void feed_environment(std::uint8_t byte, std::vector<Parsed>& out);
  void feed_decimal_point(std::vector<Parsed>& out);
  void select(std::uint8_t letter, std::uint8_t byte);

  // Handlers of a byte of an argument. Each returns false if the byte is not part of it and must be
  // handled again.
  bool feed_argument(std::uint8_t byte, std::vector<Parsed>& out);
  bool feed_number(std::uint8_t byte, std::vector<Parsed>& out);
  bool feed_digit(std::uint8_t byte, std::vector<Parsed>& out);
  bool feed_period(std::uint8_t byte, std::vector<Parsed>& out);
  bool feed_list(std::uint8_t byte, std::vector<Parsed>& out);

  void end_number(std::vector<Parsed>& out);
  void end_period(std::vector<Parsed>& out);
  void end_digit(int digit, std::vector<Parsed>& out);
  void push_list_value();
  std::variant<Command, Problem> list_result() const;

  void consume(std::uint8_t byte);
  void emit(std::variant<Command, Problem> what, std::vector<Parsed>& out);
  void emit_byte(std::uint8_t byte, std::variant<Command, Problem> what, std::vector<Parsed>& out);
  void junk(std::uint8_t byte, Problem problem, std::vector<Parsed>& out);
  void incomplete(std::vector<Parsed>& out);
  void open(Mode mode, std::uint8_t byte);

  Profile profile_;
  Mode mode_ = Mode::kIdle;
  char label_ = 0;              ///< the selected joint, or 0
  char opener_ = 0;             ///< the byte that opened the argument: P R ! * . %
  bool skips_numbers_ = false;  ///< after an unknown byte, until the next letter
  bool list_is_bad_ = false;
  std::uint8_t list_size_ = 0;
  Number number_;
  std::array<std::int32_t, 3> list_{};
  std::uint64_t offset_ = 0;  ///< offset of the current byte
  std::uint64_t from_ = 0;    ///< offset of the first byte in raw_
  std::uint64_t to_ = 0;      ///< offset after the last byte in raw_
  RawBytes raw_;
  LineWord word_;  ///< the current line
};

}  // namespace xr3
