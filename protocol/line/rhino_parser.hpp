// The incremental parser of the serial line. A command is emitted at its last byte; numbers end at
// the first byte that is not a digit; unknown bytes are skipped and reported. It follows the
// paper's Tables VI and VII and the Rhino Mark III. Independent of the machine, never throws. A
// value of a few dozen bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "core/command.hpp"
#include "core/model.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

/// The reason why bytes were not executed.
enum class ProblemCode : std::uint8_t {
  kUnknownByte,
  kNumberOutOfRange,
  kSpeedOutOfRange,
  kNoJointSelected,
  kIncompleteCommand,
  kBadViewVector,
  kBadCameraArgument,
  kDisabled,
  kNotForDevice,
};

/// The purpose of the bytes, if the parser recognises it.
enum class Subject : std::uint8_t {
  kNone,
  kMove,
  kSpeed,
  kOutput,
  kView,
  kCamera,
  kPeriod,
  kStatus,
  kSkippedNumber,  ///< digits after an unknown byte, up to the next letter
};

struct Problem {
  ProblemCode code = ProblemCode::kUnknownByte;
  Subject subject = Subject::kNone;
  bool operator==(const Problem&) const = default;
};

/// The first bytes of a command, for messages; longer commands are cut.
struct RawBytes {
  static constexpr std::size_t kMax = 22;
  std::array<std::uint8_t, kMax> bytes{};
  std::uint8_t size = 0;
  bool was_cut = false;

  void push(std::uint8_t byte) {
    if (size < kMax)
      bytes[size++] = byte;
    else
      was_cut = true;
  }
  std::string_view view() const { return {reinterpret_cast<const char*>(bytes.data()), size}; }
  bool operator==(const RawBytes&) const = default;
};

/// A command or problem, and its bytes [from, to) in the line's input.
struct Parsed {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  RawBytes raw;
  std::variant<Command, Problem> what;
  bool operator==(const Parsed&) const = default;
};

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
};

}  // namespace xr3
