// Keys that are sent at once: what is sent, what is an escape, and what is shown.
#include "tools/term/typist.hpp"

#include <gtest/gtest.h>

namespace xr3::term {
namespace {

/// What some keys cause: the bytes sent, the other requests as words, and the screen.
struct Typed {
  std::string sent;
  std::string requests;
  std::string shown;
};

struct Recorder {
  Typed& typed;
  void operator()(const SendBytes& data) const { typed.sent += data.bytes; }
  void operator()(const SendFile& file) const { typed.requests += "[file " + file.path + "]"; }
  void operator()(const SendBreak&) const { typed.requests += "[break]"; }
  void operator()(const ShowHelp&) const { typed.requests += "[help]"; }
  void operator()(const ShowHint&) const { typed.requests += "[hint]"; }
  void operator()(const Quit&) const { typed.requests += "[quit]"; }
};

Typed type(Typist& typist, std::string_view keys) {
  Typed typed;
  for (const Keystroke& key : KeyReader().feed(keys)) {
    const Typist::TypingResult outcome = typist.press(key);
    typed.shown += outcome.echo;
    for (const UserRequest& request : outcome.requests) std::visit(Recorder{typed}, request);
  }
  return typed;
}

struct TypedRow {
  const char* what;
  std::string_view keys;
  std::string_view sent;
  std::string_view requests;
  std::string_view shown;
};

constexpr TypedRow kTypedRows[] = {
    {"each key is sent", "E+5\rE?", "E+5\rE?", "", "E+5\nE?"},
    {"control characters and bytes over 7F are readable", "\x01\xe4", "\x01\xe4", "", "\\x01\\xe4"},
    {"quit", "~.", "", "[quit]", "~.\n"},
    {"quit after a line", "E+5\r~.", "E+5\r", "[quit]", "E+5\n~.\n"},
    {"Ctrl-C quits anywhere", "E\x03", "E", "[quit]", "E\n"},
    {"Ctrl-C quits in an escape", "~s f\x03", "", "[quit]", "~s f\n"},
    {"Ctrl-D at the start of a line", "\x04", "", "[quit]", ""},
    {"~ in a line is data", "E~.", "E~.", "", "E~."},
    {"two ~ are one, and the line has begun", "~~.", "~.", "", "~."},
    {"an unknown escape is data", "~x.", "~x.", "", "~x."},
    {"~ and Enter", "~\r", "~\r", "", "~\n"},
    {"~ taken back",
     "~\x7f"
     "E",
     "E", "", "~\b \bE"},
    {"break, help", "~b~?", "", "[break][help]", "~b\n~?\n"},
    {"a file", "~s a b\r", "", "[file a b]", "~s a b\n"},
    {"a file name corrected", "~s ax\x7f\r", "", "[file a]", "~s ax\b \b\n"},
    {"a file name taken back", "~s\x7f.", "", "[quit]", "~s\b \b.\n"},
    {"a file without a name", "~s\r", "", "[hint]", "~s\n"},
    {"no blank before the file", "~sx\r", "", "[hint]", "~sx\n"},
    {"keys that cannot be taken back are not sent; one hint", "E\x7f\x1b[A5", "E5", "[hint]", "E5"},
};

TEST(Typist, SendsShowsAndRecognisesEscapes) {
  for (const TypedRow& row : kTypedRows) {
    Typist typist;
    const Typed typed = type(typist, row.keys);
    EXPECT_EQ(typed.sent, row.sent) << row.what;
    EXPECT_EQ(typed.requests, row.requests) << row.what;
    EXPECT_EQ(typed.shown, row.shown) << row.what;
  }
}

TEST(Typist, AnEscapeMayFollowAReply) {
  Typist typist;
  EXPECT_EQ(type(typist, "E?").sent, "E?");
  typist.begin_line();
  EXPECT_EQ(type(typist, "~.").requests, "[quit]");
  type(typist, "~");
  typist.begin_line();
  EXPECT_EQ(type(typist, "b").requests, "[break]") << "a reply does not end an escape";
}

}  // namespace
}  // namespace xr3::term
