#include "protocol/recording/running_check.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3::recording {
namespace {

std::string check_of(std::string_view bytes) {
  RunningCheck check;
  check.add(bytes);
  return check.text();
}

// The check value of CRC-24/OPENPGP is 21CF02.
TEST(RunningCheck, IsTheCrcOfRfc4880) { EXPECT_EQ(check_of("123456789"), "Ic8C"); }

TEST(RunningCheck, DoesNotDependOnPieces) {
  RunningCheck check;
  for (const char* piece : {"12", "", "3456", "789"}) check.add(piece);
  EXPECT_EQ(check.text(), check_of("123456789"));
}

TEST(RunningCheck, DiffersForEveryOtherByte) {
  for (int other = 0; other < 256; ++other) {
    if (other == '5') continue;
    EXPECT_NE(check_of(std::string("1234") + static_cast<char>(other) + "6789"), "Ic8C");
  }
}

}  // namespace
}  // namespace xr3::recording
