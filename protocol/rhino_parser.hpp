// The byte-fed parser of the serial line: bytes act as they arrive, numbers end at the first byte
// that is not a digit, junk is skipped and reported. It follows the paper's Tables VI and VII and the
// Rhino Mark III; it knows nothing of the machine and never throws. A value of a few dozen bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "core/command.hpp"
#include "core/model.hpp"

namespace xr3 {

/// Why bytes were not obeyed.
enum class ProblemCode : std::uint8_t {
  kUnknownByte,
  kNumberOutOfRange,
  kSpeedOutOfRange,
  kNoJointSelected,
  kIncompleteCommand,
  kBadViewVector,
  kBadCameraArgument,
  kDisabled,
};

/// What the bytes were meant for, as far as the parser could tell.
enum class Subject : std::uint8_t {
  kNone,
  kMove,
  kSpeed,
  kOutput,
  kView,
  kCamera,
  kPeriod,
  kStatus,
  kSkippedNumber,  ///< digits after junk, up to the next letter
};

struct Problem {
  ProblemCode code = ProblemCode::kUnknownByte;
  Subject subject = Subject::kNone;
  bool operator==(const Problem&) const = default;
};

/// The first bytes of a command, for people to read; longer ones are cut.
struct RawBytes {
  static constexpr std::size_t kMost = 22;
  std::array<std::uint8_t, kMost> bytes{};
  std::uint8_t size = 0;
  bool was_cut = false;

  void push(std::uint8_t byte);
  std::string_view view() const { return {reinterpret_cast<const char*>(bytes.data()), size}; }
  bool operator==(const RawBytes&) const = default;
};

/// One command or problem, and which bytes of the line's input it came from: [from, to).
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

  /// Takes the byte at `offset` of the line's input and appends what it completes: at most three
  /// items, so memory stays bounded whatever is sent.
  void take(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out);

  /// The same while the controller is disabled: only `A@` is read, everything else is a problem.
  void take_disabled(std::uint8_t byte, std::uint64_t offset, std::vector<Parsed>& out);

  bool operator==(const RhinoParser&) const = default;

 private:
  enum class Mode : std::uint8_t { kIdle, kNumber, kOutput, kView, kCamera, kPeriod, kStatus };

  /// A decimal number while it is read: saturating, and modulo 256 for the mark3 profile.
  struct Number {
    char sign = 0;
    std::uint8_t digits = 0;
    bool ended = false;  ///< a blank came behind its digits
    std::uint8_t modulo_256 = 0;
    std::int32_t magnitude = 0;

    void push(std::uint8_t digit);
    int value() const { return sign == '-' ? -magnitude : magnitude; }
    bool operator==(const Number&) const = default;
  };

  void take_idle(std::uint8_t byte, std::vector<Parsed>& out);
  void take_letter(std::uint8_t letter, std::uint8_t byte, std::vector<Parsed>& out);
  void take_number_start(std::uint8_t byte, std::vector<Parsed>& out);
  void take_environment(std::uint8_t byte, std::vector<Parsed>& out);
  void select(std::uint8_t letter, std::uint8_t byte);

  // Each takes a byte of an argument. False: the byte is not part of it and is to be read anew.
  bool take_argument(std::uint8_t byte, std::vector<Parsed>& out);
  bool take_number(std::uint8_t byte, std::vector<Parsed>& out);
  bool take_digit(std::uint8_t byte, std::vector<Parsed>& out);
  bool take_period(std::uint8_t byte, std::vector<Parsed>& out);
  bool take_list(std::uint8_t byte, std::vector<Parsed>& out);

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
  bool skips_numbers_ = false;  ///< junk came, and no letter since
  bool list_is_bad_ = false;
  std::uint8_t list_size_ = 0;
  Number number_;
  std::array<std::int32_t, 3> list_{};
  std::uint64_t offset_ = 0;  ///< of the byte being taken
  std::uint64_t from_ = 0;    ///< of the first byte in raw_
  std::uint64_t to_ = 0;      ///< behind the last byte in raw_
  RawBytes raw_;
};

}  // namespace xr3
