// A recording that goes on in a new file with the first input of a day.
#include "server/recording/daily_files.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr std::time_t kDaySeconds = 86'400;
constexpr std::time_t kSummer = 1'784'000'000;

class DailyFilesTest : public testing::Test {
 protected:
  LineId open() { return cell_.apply(LineOpened{"test"}, 0).line; }
  void close(LineId line) { cell_.apply(LineClosed{line, LineCloseReason::kClientClosed}, 0); }

  std::time_t now_ = kSummer;
  int begun_ = 0;
  Cell cell_{"main", test::rhino(), SimClock::manual()};
  DailyFiles files_{cell_, [this] { ++begun_; }, [this] { return now_; }};
};

TEST_F(DailyFilesTest, TheFirstInputOfADayBeginsAFile) {
  close(open());
  EXPECT_EQ(begun_, 0) << "the day on which it began";
  now_ += kDaySeconds;
  cell_.catch_up(0);
  EXPECT_EQ(begun_, 0) << "no input";
  close(open());
  EXPECT_EQ(begun_, 1);
  close(open());
  EXPECT_EQ(begun_, 1);
  now_ += 10 * kDaySeconds;
  cell_.apply(call::Call{call::Pause{}}, 0);
  EXPECT_EQ(begun_, 2);
}

TEST_F(DailyFilesTest, AnOpenLineStaysInItsFile) {
  const LineId first = open();
  now_ += kDaySeconds;
  cell_.apply(BytesIn{first, "E?"}, 0);
  const LineId second = open();
  close(first);
  close(second);
  EXPECT_EQ(begun_, 0);
  close(open());
  EXPECT_EQ(begun_, 1);
}

}  // namespace
}  // namespace xr3
