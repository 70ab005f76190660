// Whole commands in order, one inquiry at a time, replies to the line that asked.
#include "cell/device/link.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3 {
namespace {

constexpr LineId kOne = 1;
constexpr LineId kTwo = 2;
const Command kAskE = QueryError{'E'};
const Command kMoveE = Move{'E', 5};

class DeviceLinkTest : public testing::Test {
 protected:
  DeviceLinkTest() { link_.set_open(true); }

  /// The bytes that leave now.
  std::string leaving() {
    std::string bytes;
    while (!link_.outbox().empty()) {
      bytes += link_.outbox();
      link_.sent(link_.outbox().size(), now_);
    }
    return bytes;
  }
  /// The line whose inquiry a byte answers now; 0: none.
  LineId answer() {
    const auto asked = link_.receive(now_);
    return asked ? asked->line.value_or(0) : 0;
  }

  Tick now_ = 0;
  DeviceLink link_{"/dev/ttyUSB0", {9600, SerialFrame{}}};
};

TEST_F(DeviceLinkTest, MovesLeaveAtOnce) {
  link_.add(kOne, kMoveE, now_);
  link_.add(kTwo, Move{'F', -3}, now_);
  EXPECT_EQ(leaving(), "E+5\rF-3\r");
  EXPECT_EQ(link_.bytes_out(), 8U);
}

TEST_F(DeviceLinkTest, NothingLeavesBehindAnInquiryBeforeItsReply) {
  link_.add(kOne, kAskE, now_);
  link_.add(kTwo, kMoveE, now_);
  link_.add(kTwo, Command{QuerySwitchesI{}}, now_);
  link_.add(kOne, kAskE, now_);
  EXPECT_EQ(leaving(), "E?");
  EXPECT_EQ(answer(), kOne);
  EXPECT_EQ(leaving(), "E+5\rE?");
  EXPECT_EQ(answer(), kOne);
  EXPECT_EQ(leaving(), "I");
  EXPECT_EQ(answer(), kTwo);
  EXPECT_EQ(leaving(), "");
}

TEST_F(DeviceLinkTest, AByteThatNobodyAskedFor) {
  EXPECT_FALSE(link_.receive(now_));
  EXPECT_EQ(link_.bytes_in(), 1U);
}

TEST_F(DeviceLinkTest, AnInquiryIsForgottenHalfASecondAfterItsLastBit) {
  link_.add(kOne, kAskE, now_);  // 22 bits at 9600 baud: 2.29 ms
  link_.add(kTwo, kAskE, now_);
  EXPECT_EQ(leaving(), "E?");
  EXPECT_EQ(link_.deadline(), 503);
  EXPECT_FALSE(link_.expire(502));
  EXPECT_EQ(link_.expire(503)->line, kOne);
  EXPECT_EQ(leaving(), "E?") << "of the other line";
  EXPECT_EQ(link_.deadline(), 1006);
  EXPECT_EQ(answer(), kTwo);
  EXPECT_EQ(link_.deadline(), std::nullopt);
}

TEST_F(DeviceLinkTest, TheDeadlineCountsTheBytesBeforeTheInquiry) {
  for (int i = 0; i < 100; ++i) link_.add(kOne, kMoveE, now_);
  link_.add(kOne, kAskE, now_);
  leaving();
  EXPECT_EQ(link_.deadline(), 961);  // 402 bytes of 11 bits
}

TEST_F(DeviceLinkTest, ADeviceThatIsFasterThanItsSettingsDelaysADeadlineByOneBuffer) {
  for (int i = 0; i < 5000; ++i) {
    link_.add(kOne, kMoveE, now_);
    EXPECT_EQ(leaving(), "E+5\r");
  }
  link_.add(kOne, kAskE, now_);
  EXPECT_EQ(link_.deadline(), 5267);  // 4160 bytes of 11 bits
}

TEST_F(DeviceLinkTest, ALineThatLeavesGetsNoReply) {
  link_.add(kOne, kAskE, now_);
  link_.add(kOne, kMoveE, now_);
  link_.add(kOne, kAskE, now_);
  link_.forget(kOne);
  EXPECT_EQ(leaving(), "E?");
  EXPECT_EQ(answer(), 0);
  EXPECT_EQ(leaving(), "E+5\rE?") << "its whole commands are still sent";
  EXPECT_EQ(answer(), 0);
}

TEST_F(DeviceLinkTest, ALineWithManyCommandsWaits) {
  link_.add(kOne, kAskE, now_);
  while (link_.accepts(kTwo)) link_.add(kTwo, kMoveE, now_);
  EXPECT_TRUE(link_.accepts(kOne));
  EXPECT_TRUE(link_.take_woken().empty());
  leaving();
  answer();
  EXPECT_EQ(leaving().size(), DeviceLink::kMaxWaiting);
  EXPECT_EQ(link_.take_woken(), std::vector<LineId>{kTwo});
  EXPECT_TRUE(link_.accepts(kTwo));
}

TEST_F(DeviceLinkTest, AFloodIsBoundedAlthoughNobodyAsks) {
  std::size_t added = 0;
  for (; link_.accepts(kOne); ++added) link_.add(kOne, kMoveE, now_);
  EXPECT_LE(added * 4, DeviceLink::kFullOutbox + DeviceLink::kMaxWaiting + 4);
  EXPECT_LE(link_.outbox().size(), DeviceLink::kFullOutbox + 4);
  EXPECT_EQ(leaving().size(), added * 4);
  EXPECT_EQ(link_.take_woken(), std::vector<LineId>{kOne});
}

TEST_F(DeviceLinkTest, LinesTakeTurns) {
  while (link_.accepts(kOne)) link_.add(kOne, kMoveE, now_);
  link_.add(kTwo, kAskE, now_);
  const std::string bytes = leaving();
  EXPECT_LE(bytes.find("E?"), DeviceLink::kFullOutbox + 4) << "not behind all of the other line";
  EXPECT_EQ(answer(), kTwo);
}

TEST_F(DeviceLinkTest, AStopDropsWhatWaits) {
  link_.add(kOne, kMoveE, now_);
  link_.add(kOne, kAskE, now_);
  link_.add(kTwo, kMoveE, now_);
  link_.stop(now_);
  EXPECT_EQ(leaving(), "AXBXCXDXEXFXGXHX");
  EXPECT_EQ(answer(), 0) << "the inquiry has not left";
  EXPECT_EQ(link_.stops(), 1U);
}

TEST_F(DeviceLinkTest, AStopKeepsAnInquiryThatHasLeft) {
  link_.add(kOne, kAskE, now_);
  EXPECT_EQ(leaving(), "E?");
  link_.stop(now_);
  link_.add(kTwo, kAskE, now_);
  EXPECT_EQ(leaving(), "AXBXCXDXEXFXGXHX") << "the other inquiry waits";
  EXPECT_EQ(answer(), kOne);
  EXPECT_EQ(leaving(), "E?");
  EXPECT_EQ(answer(), kTwo);
}

TEST_F(DeviceLinkTest, RepeatedStopsDoNotKeepALostInquiry) {
  link_.add(kOne, kAskE, now_);
  EXPECT_EQ(leaving(), "E?");
  const std::optional<Tick> deadline = link_.deadline();
  for (int i = 0; i < 20; ++i) {
    now_ += 50;
    link_.stop(now_);
    leaving();
    if (now_ < *deadline) {
      EXPECT_EQ(link_.deadline(), deadline);
    }
    const auto silent = link_.expire(now_);
    EXPECT_EQ(silent.has_value(), now_ - 50 < *deadline && now_ >= *deadline);
  }
}

TEST_F(DeviceLinkTest, AnAbsentDeviceGetsNothing) {
  link_.add(kOne, kAskE, now_);
  link_.add(kTwo, kMoveE, now_);
  link_.set_open(false);
  link_.add(kOne, kMoveE, now_);
  link_.stop(now_);
  link_.set_open(true);
  EXPECT_EQ(leaving(), "");
  EXPECT_EQ(link_.deadline(), std::nullopt);
}

TEST_F(DeviceLinkTest, SwitchingDropsCommandsThatWaitAndKeepsTheInquiry) {
  link_.engage(true);
  link_.add(kOne, kAskE, now_);
  link_.add(kTwo, kMoveE, now_);
  link_.engage(false);
  EXPECT_EQ(leaving(), "E?");
  EXPECT_EQ(answer(), kOne);
  EXPECT_EQ(leaving(), "");
  EXPECT_EQ(link_.switches(), 2U);
}

}  // namespace
}  // namespace xr3
