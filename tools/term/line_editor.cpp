#include "tools/term/line_editor.hpp"

#include <algorithm>
#include <utility>

namespace xr3::term {
namespace {

// Control keys of the shell's line editor.
constexpr char kCtrlA = '\x01';
constexpr char kCtrlE = '\x05';
constexpr char kCtrlK = '\x0b';
constexpr char kCtrlU = '\x15';

bool is_printable(char byte) { return byte >= ' ' && byte <= '~'; }

}  // namespace

LineEditor::Result LineEditor::press(const Keystroke& key) {
  switch (key.code) {
    case KeyCode::kByte: press_byte(key.byte); break;
    case KeyCode::kEnter: return finish();
    case KeyCode::kInterrupt:
      if (text_.empty()) return Result::kQuit;
      erase(0, text_.size());
      shown_ = history_.size();
      break;
    case KeyCode::kEndOfFile:
      if (text_.empty()) return Result::kQuit;
      erase(cursor_, cursor_ + 1);
      break;
    default: move(key.code);
  }
  return Result::kNothing;
}

void LineEditor::press_byte(char byte) {
  switch (byte) {
    case kCtrlA: cursor_ = 0; return;
    case kCtrlE: cursor_ = text_.size(); return;
    case kCtrlK: return erase(cursor_, text_.size());
    case kCtrlU: return erase(0, cursor_);
    default: break;
  }
  if (!is_printable(byte) || text_.size() >= kMaxBytes) return;
  text_.insert(cursor_, 1, byte);
  ++cursor_;
}

void LineEditor::move(KeyCode code) {
  switch (code) {
    case KeyCode::kBackspace:
      if (cursor_ > 0) erase(cursor_ - 1, cursor_);
      break;
    case KeyCode::kDelete: erase(cursor_, cursor_ + 1); break;
    case KeyCode::kLeft: cursor_ -= cursor_ > 0 ? 1 : 0; break;
    case KeyCode::kRight: cursor_ = std::min(cursor_ + 1, text_.size()); break;
    case KeyCode::kHome: cursor_ = 0; break;
    case KeyCode::kEnd: cursor_ = text_.size(); break;
    case KeyCode::kUp:
      if (shown_ > 0) recall(shown_ - 1);
      break;
    case KeyCode::kDown:
      if (shown_ < history_.size()) recall(shown_ + 1);
      break;
    default: break;
  }
}

// Shows an entry of the history. Behind the last entry is the line that was begun before.
void LineEditor::recall(std::size_t entry) {
  if (shown_ == history_.size()) draft_ = text_;
  shown_ = entry;
  text_ = entry == history_.size() ? draft_ : history_[entry];
  cursor_ = text_.size();
}

void LineEditor::erase(std::size_t from, std::size_t to) {
  text_.erase(from, to - from);
  cursor_ = std::min(from, text_.size());
}

LineEditor::Result LineEditor::finish() {
  line_ = std::exchange(text_, {});
  cursor_ = 0;
  const bool is_new = !line_.empty() && (history_.empty() || history_.back() != line_);
  if (is_new) history_.push_back(line_);
  if (history_.size() > kMaxHistory) history_.erase(history_.begin());
  shown_ = history_.size();
  return Result::kLine;
}

}  // namespace xr3::term
