// Escapes at the start of a line.
#include "tools/term/request.hpp"

#include <gtest/gtest.h>

namespace xr3::term {
namespace {

TEST(Escape, HasTheseForms) {
  EXPECT_EQ(escape_of("."), UserRequest(Quit{}));
  EXPECT_EQ(escape_of(". "), UserRequest(Quit{}));
  EXPECT_EQ(escape_of("b"), UserRequest(SendBreak{}));
  EXPECT_EQ(escape_of("?"), UserRequest(ShowHelp{}));
  EXPECT_EQ(escape_of("~"), UserRequest(SendBytes{"~"}));
  EXPECT_EQ(escape_of("s a file.txt "), UserRequest(SendFile{"a file.txt"}));
  for (const auto* none : {"", "x", ".5", "bb", "sx", "E?"}) EXPECT_FALSE(escape_of(none)) << none;
  for (const auto* nameless : {"s", "s ", "s   "}) {
    ASSERT_TRUE(escape_of(nameless));
    EXPECT_TRUE(std::holds_alternative<ShowHint>(*escape_of(nameless))) << nameless;
  }
}

TEST(LineRequest, IsAnEscapeOrDataWithACr) {
  EXPECT_EQ(request_of_line("E+5"), UserRequest(SendBytes{"E+5\r"}));
  EXPECT_EQ(request_of_line(""), UserRequest(SendBytes{"\r"}));
  EXPECT_EQ(request_of_line("~."), UserRequest(Quit{}));
  EXPECT_EQ(request_of_line("~s f"), UserRequest(SendFile{"f"}));
  EXPECT_EQ(request_of_line("~~"), UserRequest(SendBytes{"~\r"}));
  EXPECT_EQ(request_of_line("~~."), UserRequest(SendBytes{"~.\r"}));
  EXPECT_EQ(request_of_line("~x"), UserRequest(SendBytes{"~x\r"}));
  EXPECT_EQ(request_of_line("E~."), UserRequest(SendBytes{"E~.\r"}));
}

}  // namespace
}  // namespace xr3::term
