// Text within HTML and XML.
#include "tools/text/markup.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

TEST(Xml, EscapesAndKeepsLetters) { EXPECT_EQ(xml("a<b>&\"é€😀"), "a&lt;b&gt;&amp;&quot;é€😀"); }

TEST(Xml, HasNoControlCharacters) {
  EXPECT_EQ(xml("a\x1b[2K\n\t\r"), R"(a\x1b[2K  \x0d)");
  EXPECT_EQ(html("a\r\n\tb\x07"), "a\\x0d\n\tb\\x07");
}

}  // namespace
}  // namespace xr3
