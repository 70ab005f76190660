// Bytes as hexadecimal lines.
#include "tools/term/hex_text.hpp"

#include <gtest/gtest.h>

namespace xr3::term {
namespace {

TEST(HexLines, HaveAMarkAndSixteenBytes) {
  EXPECT_EQ(hex_lines('>', ""), "");
  EXPECT_EQ(hex_lines('>', "E?\r"), "> 45 3f 0d\n");
  EXPECT_EQ(hex_lines('<', "0123456789abcdef\xff"),
            "< 30 31 32 33 34 35 36 37 38 39 61 62 63 64 65 66\n< ff\n");
}

}  // namespace
}  // namespace xr3::term
