// The meaning of bytes of the serial line: a command, or a problem with a code, and the bytes
// themselves. Values without text; explain/diagnostic.hpp has the sentences.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "core/command.hpp"

namespace xr3 {

/// The reason why bytes were not executed; or, for kDecimalPoint and kWord, why the commands that
/// were executed are probably not those that were meant.
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
  kDecimalPoint,  ///< directly after a number
  kWord,          ///< all bytes of a line; see line_word.hpp
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
  kHelp,           ///< for kWord, as those below: the purpose of the word
  kLeaving,
  kStopping,
  kHoming,
  kResetting,
  kJaws,
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

}  // namespace xr3
