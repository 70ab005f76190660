// Editing a line, and its history.
#include "tools/term/line_editor.hpp"

#include <gtest/gtest.h>

namespace xr3::term {
namespace {

/// Presses keys; lines are collected, each with a `|`. `<` quits.
std::string press_keys(LineEditor& editor, std::string_view keys) {
  std::string lines;
  for (const Keystroke& key : KeyReader().feed(keys)) {
    const LineEditor::Result result = editor.press(key);
    if (result == LineEditor::Result::kLine) lines += editor.line() + "|";
    if (result == LineEditor::Result::kQuit) lines += "<";
  }
  return lines;
}

constexpr std::string_view kUp = "\x1b[A";
constexpr std::string_view kDown = "\x1b[B";

struct EditedRow {
  const char* what;
  std::string_view keys;
  std::string_view text;
  std::size_t cursor;
};

constexpr EditedRow kEditedRows[] = {
    {"typing", "E+5", "E+5", 3},
    {"in the middle", "E5\x1b[D+", "E+5", 2},
    {"backspace and delete", "Exy5\x1b[D\x7f\x1b[D\x1b[3~", "E5", 1},
    {"nothing to delete", "\x7f\x1b[3~\x1b[D\x1b[C", "", 0},
    {"home and end", "+5\x1b[HE\x1b[F0", "E+50", 4},
    {"Ctrl-A, Ctrl-E, Ctrl-K, Ctrl-U", "abc\x01x\x05y\x1b[D\x0b\x1b[D\x15", "c", 0},
    {"Ctrl-D deletes forward", "ab\x1b[H\x04", "b", 0},
    {"Ctrl-C clears", "ab\x03", "", 0},
    {"other keys and bytes are ignored", "a\t\xc3\xa4\x1b[15~b", "ab", 2},
};

TEST(LineEditor, Edits) {
  for (const EditedRow& row : kEditedRows) {
    LineEditor editor;
    EXPECT_EQ(press_keys(editor, row.keys), "") << row.what;
    EXPECT_EQ(editor.text(), row.text) << row.what;
    EXPECT_EQ(editor.cursor(), row.cursor) << row.what;
  }
}

TEST(LineEditor, EndsLinesAndQuits) {
  LineEditor editor;
  EXPECT_EQ(press_keys(editor, "E?\rE+5\x1b[D\r\r"), "E?|E+5||");
  EXPECT_EQ(editor.text(), "");
  EXPECT_EQ(press_keys(editor, "\x04"), "<");
  EXPECT_EQ(press_keys(editor, "a\x03\x03"), "<");
}

TEST(LineEditor, RecallsEarlierLines) {
  LineEditor editor;
  press_keys(editor, "one\rtwo\rtwo\r\rdraft");
  press_keys(editor, kUp);
  EXPECT_EQ(editor.text(), "two");
  press_keys(editor, kUp);
  EXPECT_EQ(editor.text(), "one") << "equal and empty lines are kept once, or not";
  press_keys(editor, kUp);
  EXPECT_EQ(editor.text(), "one");
  press_keys(editor, kDown);
  press_keys(editor, kDown);
  EXPECT_EQ(editor.text(), "draft");
  press_keys(editor, kDown);
  EXPECT_EQ(editor.text(), "draft");
  press_keys(editor, kUp);
  EXPECT_EQ(press_keys(editor, "!\r"), "two!|") << "an earlier line changed is a new one";
  press_keys(editor, kUp);
  EXPECT_EQ(editor.text(), "two!");
}

TEST(LineEditor, IsBounded) {
  LineEditor editor;
  press_keys(editor, std::string(3 * LineEditor::kMaxBytes, 'x'));
  EXPECT_EQ(editor.text().size(), LineEditor::kMaxBytes);
  for (std::size_t i = 0; i < LineEditor::kMaxHistory + 5; ++i) {
    press_keys(editor, "\x15" + std::to_string(i) + "\r");
  }
  for (std::size_t i = 0; i < 2 * LineEditor::kMaxHistory; ++i) press_keys(editor, kUp);
  EXPECT_EQ(editor.text(), "5");
}

}  // namespace
}  // namespace xr3::term
