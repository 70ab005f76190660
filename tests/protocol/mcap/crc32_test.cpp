#include "protocol/mcap/crc32.hpp"

#include <gtest/gtest.h>

namespace xr3::mcap {
namespace {

// The check value of CRC-32/ISO-HDLC is CBF43926.
TEST(Crc32, IsThatOfIso3309) { EXPECT_EQ(crc32("123456789"), 0xCBF43926U); }

TEST(Crc32, DoesNotDependOnPieces) {
  Crc32 crc;
  for (const char* piece : {"12", "", "3456", "789"}) crc.add(piece);
  EXPECT_EQ(crc.value(), crc32("123456789"));
}

TEST(Crc32, OfNothingIsZero) { EXPECT_EQ(crc32(""), 0U); }

}  // namespace
}  // namespace xr3::mcap
