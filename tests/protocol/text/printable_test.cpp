// Names from outside as text that a terminal, the log and reports can show.
#include "protocol/text/printable.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/json/source.hpp"

namespace xr3 {
namespace {

using namespace std::string_literals;

struct PrintableCase {
  const char* what;
  std::string text;
  std::string printable;
};

TEST(Printable, EscapesEachByteOfACharacterThatIsNotPrintable) {
  const PrintableCase cases[] = {
      {"text", "Blöcke – 漢 🤖 ~", "Blöcke – 漢 🤖 ~"},
      {"C0 and DEL", "a\x1b[31m\t\r\0\x7f"s, R"(a\x1b[31m\x09\x0d\x00\x7f)"},
      {"a line feed", "a\nb", R"(a\x0ab)"},
      {"C1", "\u0080\u009b2J\u009f\u00a0", "\\xc2\\x80\\xc2\\x9b2J\\xc2\\x9f\u00a0"},
      {"direction", "\u202ea\u202a\u2066\u2069\u200e\u200f\u061c",
       R"(\xe2\x80\xaea\xe2\x80\xaa\xe2\x81\xa6\xe2\x81\xa9\xe2\x80\x8e\xe2\x80\x8f\xd8\x9c)"},
      {"separators of lines", "\u2027\u2028\u2029\u202f",
       "\u2027\\xe2\\x80\\xa8\\xe2\\x80\\xa9\u202f"},
      {"not in XML", "\ufffd\xef\xbf\xbe\xef\xbf\xbf", R"(�\xef\xbf\xbe\xef\xbf\xbf)"},
      {"Latin-1", "Ren\xe9 \xe9\xe9", R"(Ren\xe9 \xe9\xe9)"},
      {"an unfinished character", "\xe2\x82", R"(\xe2\x82)"},
      {"overlong forms", "\xc0\x9b\xe0\x80\x9b", R"(\xc0\x9b\xe0\x80\x9b)"},
      {"a surrogate", "\xed\xa0\x80", R"(\xed\xa0\x80)"},
      {"beyond Unicode", "\xf4\x90\x80\x80", R"(\xf4\x90\x80\x80)"},
      {"nothing", "", ""},
  };
  for (const PrintableCase& each : cases) {
    SCOPED_TRACE(each.what);
    EXPECT_EQ(printable_line(each.text), each.printable);
    EXPECT_EQ(printable_line(each.printable), each.printable) << "printable text stays as it is";
  }
}

TEST(Printable, LinesKeepTheirLineFeedsAndTabs) {
  EXPECT_EQ(printable_lines("a\x1b\n\tb\r\n"), "a\\x1b\n\tb\\x0d\n");
}

TEST(Printable, JsonKeepsItsValues) {
  const Json value = {{"a\u202e", "x\x1b\u009b\x7f\u2028 é\n\uffff"s}};
  const std::string text = printable_json(value.dump() + "\n");
  EXPECT_EQ(text, R"({"a\u202e":"x\u001b\u009b\u007f\u2028 é\n\uffff"})"
                  "\n");
  EXPECT_EQ(Json::parse(text), value);
}

}  // namespace
}  // namespace xr3
