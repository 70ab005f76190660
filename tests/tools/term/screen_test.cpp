// What is written to the terminal: applied to a simple one, what a user sees.
#include "tools/term/screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace xr3::term {
namespace {

/// A terminal that knows CR, LF and backspace, with output processing.
class Paper {
 public:
  void write(std::string_view text) {
    for (const char byte : text) {
      std::string& line = lines_.back();
      if (byte == '\n') {
        lines_.emplace_back();
        column_ = 0;
      } else if (byte == '\r') {
        column_ = 0;
      } else if (byte == '\b') {
        column_ -= column_ > 0 ? 1 : 0;
      } else {
        if (column_ == line.size()) line.push_back(' ');
        line[column_++] = byte;
      }
      widest_ = std::max(widest_, column_);
    }
  }
  /// The lines with a `/` between them, with a `^` at the cursor.
  std::string text() const {
    std::string all;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      std::string line = lines_[i];
      if (i + 1 == lines_.size()) {
        line.resize(std::max(line.size(), column_), ' ');
        line.insert(column_, "^");
      }
      line.erase(line.find_last_not_of(' ') + 1);
      all += (i == 0 ? "" : "/") + line;
    }
    return all;
  }
  std::size_t widest() const { return widest_; }

 private:
  std::vector<std::string> lines_{""};
  std::size_t column_ = 0;
  std::size_t widest_ = 0;
};

TEST(TermScreen, RepliesBeginALineOfTheirOwn) {
  Paper paper;
  TermScreen screen;
  paper.write(screen.type("E?"));
  EXPECT_FALSE(screen.is_at_line_start());
  paper.write(screen.print("45"));
  EXPECT_EQ(paper.text(), "E?/45/^");
  EXPECT_TRUE(screen.is_at_line_start());
  paper.write(screen.print("46\n47\n"));
  EXPECT_EQ(paper.text(), "E?/45/46/47/^");
  paper.write(screen.type("F?"));
  paper.write(screen.type("\n"));
  paper.write(screen.print("32"));
  EXPECT_EQ(paper.text(), "E?/45/46/47/F?/32/^");
  EXPECT_EQ(screen.print(""), "");
  EXPECT_EQ(screen.type(""), "");
}

void press_all(LineEditor& editor, std::string_view keys) {
  for (const Keystroke& key : KeyReader().feed(keys)) editor.press(key);
}

TEST(TermScreen, TheEditedLineStaysBelowReplies) {
  Paper paper;
  TermScreen screen;
  LineEditor editor;
  press_all(editor, "E+50\x1b[D\x1b[D");
  paper.write(screen.edit(editor, 80));
  EXPECT_EQ(paper.text(), "> E+^50");
  paper.write(screen.print("a reply that is longer"));
  EXPECT_EQ(paper.text(), "a reply that is longer/> E+^50");
  press_all(editor, "\x1b[3~");
  paper.write(screen.edit(editor, 80));
  EXPECT_EQ(paper.text(), "a reply that is longer/> E+^0");
  paper.write(screen.end_edit());
  paper.write(screen.print("x"));
  EXPECT_EQ(paper.text(), "a reply that is longer/> E+0/x/^");
}

TEST(TermScreen, ALongLineIsScrolled) {
  Paper paper;
  TermScreen screen;
  LineEditor editor;
  for (int i = 0; i < 30; ++i) {
    press_all(editor, std::to_string(i % 10));
    paper.write(screen.edit(editor, 20));
  }
  EXPECT_EQ(paper.text(), "> 4567890123456789^");
  press_all(editor, "\x1b[H");
  paper.write(screen.edit(editor, 20));
  EXPECT_EQ(paper.text(), "> ^01234567890123456");
  EXPECT_LT(paper.widest(), 20U) << "the terminal must not wrap";
  paper.write(screen.edit(editor, 0));
  EXPECT_EQ(paper.text(), "> ^0123456");
}

}  // namespace
}  // namespace xr3::term
