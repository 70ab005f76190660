// The keys of a terminal, from the bytes that it sends. Cursor keys arrive as escape sequences of
// several bytes (VT100, xterm, Linux), which may be split.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace xr3::term {

enum class KeyCode : std::uint8_t {
  kByte,  ///< a character, or a part of one in UTF-8, or a control character without an own code
  kEnter,
  kBackspace,
  kDelete,
  kLeft,
  kRight,
  kUp,
  kDown,
  kHome,
  kEnd,
  kInterrupt,  ///< Ctrl-C
  kEndOfFile,  ///< Ctrl-D
  kOther,      ///< a key without a function here, such as F1
};

struct Keystroke {
  KeyCode code = KeyCode::kOther;
  char byte = 0;  ///< kByte: the byte
  bool operator==(const Keystroke&) const = default;
};

class KeyReader {
 public:
  /// The keys that these bytes complete.
  std::vector<Keystroke> feed(std::string_view bytes);

 private:
  enum class SequenceMode : std::uint8_t { kPlain, kEscape, kSequence, kShortSequence };

  void feed(char byte, std::vector<Keystroke>& keys);

  SequenceMode mode_ = SequenceMode::kPlain;
  int number_ = 0;  ///< the first parameter of a sequence, saturated
  bool is_first_number_ = true;
};

}  // namespace xr3::term
