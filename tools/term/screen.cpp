#include "tools/term/screen.hpp"

#include <algorithm>

namespace xr3::term {
namespace {

constexpr std::string_view kPrompt = "> ";
constexpr std::size_t kMinColumns = 10;

/// The part of the text that is visible, and the cursor in it.
struct Window {
  std::string_view text;
  std::size_t cursor;
};

// The cursor's column must be visible, too, also behind the last character.
Window window_of(const LineEditor& editor, std::size_t width) {
  const std::size_t from = editor.cursor() < width ? 0 : editor.cursor() - width + 1;
  return {std::string_view(editor.text()).substr(from, width), editor.cursor() - from};
}

}  // namespace

std::string TermScreen::type(std::string_view echo) {
  if (!echo.empty()) is_at_line_start_ = echo.back() == '\n';
  return std::string(echo);
}

std::string TermScreen::print(std::string_view lines) {
  if (lines.empty()) return {};
  const std::string edited = edited_;
  const std::size_t cursor = cursor_;
  std::string text = erase_edit();
  if (edited.empty() && !is_at_line_start_) text += '\n';
  text += lines;
  if (lines.back() != '\n') text += '\n';
  is_at_line_start_ = true;
  edited_ = edited;
  cursor_ = cursor;
  return text + edited + std::string(edited.size() - cursor, '\b');
}

std::string TermScreen::edit(const LineEditor& editor, std::size_t columns) {
  const std::size_t width = std::max(columns, kMinColumns) - kPrompt.size() - 1;
  const Window window = window_of(editor, width);
  const std::string text = erase_edit();
  edited_ = std::string(kPrompt) + std::string(window.text);
  cursor_ = kPrompt.size() + window.cursor;
  return text + edited_ + std::string(edited_.size() - cursor_, '\b');
}

std::string TermScreen::end_edit() {
  edited_.clear();
  cursor_ = 0;
  is_at_line_start_ = true;
  return "\n";
}

std::string TermScreen::erase_edit() {
  if (edited_.empty()) return {};
  std::string text = "\r" + std::string(edited_.size(), ' ') + "\r";
  edited_.clear();
  cursor_ = 0;
  return text;
}

}  // namespace xr3::term
