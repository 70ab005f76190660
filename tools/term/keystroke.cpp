#include "tools/term/keystroke.hpp"

#include <algorithm>

namespace xr3::term {
namespace {

constexpr char kEscapeByte = '\x1b';
constexpr int kMaxParameter = 1000;

Keystroke plain_key(char byte) {
  switch (byte) {
    case '\r':
    case '\n': return {KeyCode::kEnter};
    case '\b':
    case '\x7f': return {KeyCode::kBackspace};
    case '\x03': return {KeyCode::kInterrupt};
    case '\x04': return {KeyCode::kEndOfFile};
    default: return {KeyCode::kByte, byte};
  }
}

/// The key of `ESC [ number ~`.
KeyCode numbered_key(int number) {
  if (number == 3) return KeyCode::kDelete;
  if (number == 1 || number == 7) return KeyCode::kHome;
  return number == 4 || number == 8 ? KeyCode::kEnd : KeyCode::kOther;
}

/// The key of a sequence with this last byte.
KeyCode sequence_key(char last, int number) {
  switch (last) {
    case 'A': return KeyCode::kUp;
    case 'B': return KeyCode::kDown;
    case 'C': return KeyCode::kRight;
    case 'D': return KeyCode::kLeft;
    case 'F': return KeyCode::kEnd;
    case 'H': return KeyCode::kHome;
    case '~': return numbered_key(number);
    default: return KeyCode::kOther;
  }
}

bool ends_sequence(char byte) { return byte >= '@' && byte <= '~'; }

}  // namespace

std::vector<Keystroke> KeyReader::feed(std::string_view bytes) {
  std::vector<Keystroke> keys;
  for (const char byte : bytes) feed(byte, keys);
  return keys;
}

// Linux sends F1 to F5 as `ESC [ [` and a letter.
void KeyReader::feed(char byte, std::vector<Keystroke>& keys) {
  switch (mode_) {
    case SequenceMode::kPlain:
      if (byte == kEscapeByte) {
        mode_ = SequenceMode::kEscape;
      } else {
        keys.push_back(plain_key(byte));
      }
      return;
    case SequenceMode::kEscape:
      number_ = 0;
      is_first_number_ = true;
      if (byte == kEscapeByte) return;
      mode_ = byte == '['   ? SequenceMode::kSequence
              : byte == 'O' ? SequenceMode::kShortSequence
                            : SequenceMode::kPlain;
      if (mode_ == SequenceMode::kPlain) keys.push_back({KeyCode::kOther});
      return;
    case SequenceMode::kSequence:
      if (byte >= '0' && byte <= '9') {
        if (is_first_number_) number_ = std::min(kMaxParameter, number_ * 10 + byte - '0');
      } else if (byte == '[') {
        mode_ = SequenceMode::kShortSequence;
        number_ = kMaxParameter;  // not a cursor key
      } else if (!ends_sequence(byte)) {
        is_first_number_ = false;
      } else {
        mode_ = SequenceMode::kPlain;
        keys.push_back({sequence_key(byte, number_)});
      }
      return;
    case SequenceMode::kShortSequence:
      mode_ = SequenceMode::kPlain;
      keys.push_back({number_ == kMaxParameter ? KeyCode::kOther : sequence_key(byte, number_)});
      return;
  }
}

}  // namespace xr3::term
