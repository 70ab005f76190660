#include "tools/term/typist.hpp"

#include <utility>

#include "protocol/explain/diagnostic.hpp"

namespace xr3::term {
namespace {

constexpr std::string_view kNotSent =
    "that key is not sent: keys go at once and cannot be taken back; --line edits lines first";

}  // namespace

Typist::TypingResult Typist::press(const Keystroke& key) {
  if (key.code == KeyCode::kInterrupt) return {"\n", {Quit{}}};
  switch (mode_) {
    case TypingMode::kEscape: return press_escape(key);
    case TypingMode::kFileName: return press_file_name(key);
    default: return press_data(key);
  }
}

void Typist::begin_line() {
  if (mode_ == TypingMode::kInLine) mode_ = TypingMode::kLineStart;
}

Typist::TypingResult Typist::press_data(const Keystroke& key) {
  if (key.code == KeyCode::kEnter) {
    mode_ = TypingMode::kLineStart;
    return {"\n", {SendBytes{"\r"}}};
  }
  if (key.code == KeyCode::kEndOfFile && mode_ == TypingMode::kLineStart) return {"", {Quit{}}};
  if (key.code != KeyCode::kByte) {
    const bool is_explained = std::exchange(is_explained_, true);
    return is_explained ? TypingResult{} : TypingResult{"", {ShowHint{kNotSent}}};
  }
  if (key.byte == kEscapeKey && mode_ == TypingMode::kLineStart) {
    mode_ = TypingMode::kEscape;
    escape_.clear();
    return {"~", {}};
  }
  mode_ = TypingMode::kInLine;
  const std::string bytes(1, key.byte);
  return {readable(bytes), {SendBytes{bytes}}};
}

// Handles a key of an escape. An unknown escape is sent as it was typed.
Typist::TypingResult Typist::press_escape(const Keystroke& key) {
  mode_ = TypingMode::kLineStart;
  if (key.code == KeyCode::kBackspace) return {"\b \b", {}};
  if (key.code == KeyCode::kEnter) return {"\n", {SendBytes{"~\r"}}};
  if (key.code != KeyCode::kByte) return {"\b \b", {}};
  const std::string typed(1, key.byte);
  if (key.byte == 's') {
    mode_ = TypingMode::kFileName;
    escape_ = typed;
    return {typed, {}};
  }
  const auto request = escape_of(typed);
  const bool is_data = !request || std::holds_alternative<SendBytes>(*request);
  if (is_data) mode_ = TypingMode::kInLine;
  // The first ~ stays on the screen: it stands for the one that is sent.
  if (key.byte == kEscapeKey) return {"", {*request}};
  if (!request) return {readable(typed), {SendBytes{"~" + typed}}};
  return {typed + "\n", {*request}};
}

Typist::TypingResult Typist::press_file_name(const Keystroke& key) {
  if (key.code == KeyCode::kBackspace) {
    escape_.pop_back();
    if (escape_.empty()) mode_ = TypingMode::kEscape;
    return {"\b \b", {}};
  }
  if (key.code == KeyCode::kByte) {
    escape_ += key.byte;
    return {std::string(1, key.byte), {}};
  }
  if (key.code != KeyCode::kEnter) return {};
  mode_ = TypingMode::kLineStart;
  const auto request = escape_of(escape_);
  if (!request) return {"\n", {ShowHint{"~s needs a space before the name of the file"}}};
  return {"\n", {*request}};
}

}  // namespace xr3::term
