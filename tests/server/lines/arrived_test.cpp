#include "server/lines/arrived.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "tests/support/line_sessions.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kFlood = std::numeric_limits<std::size_t>::max();
constexpr WallNs kPast = 0;

/// Gives a number of CRs, as many as are wanted at first, then some at a time; takes all replies.
class CrStream final : public LineStream {
 public:
  CrStream(std::size_t count, std::size_t at_once) : left_(count), at_once_(at_once) {}
  int descriptor() const override { return is_closed_ ? -1 : 0; }
  std::size_t read(std::span<char> into) override {
    const std::size_t count = std::min({into.size(), is_first_ ? kFlood : at_once_, left_});
    is_first_ = false;
    std::ranges::fill(into.first(count), '\r');
    left_ -= count;
    return count;
  }
  std::size_t write(std::string_view bytes) override { return bytes.size(); }
  void close() override { is_closed_ = true; }

 private:
  std::size_t left_;
  std::size_t at_once_;
  bool is_first_ = true;
  bool is_closed_ = false;
};

class ArrivedBytesTest : public test::LineSessionsTest {
 protected:
  /// Line 1 is the first one.
  LineId add(std::size_t count, std::size_t at_once = kFlood) {
    const auto session = open(std::make_unique<CrStream>(count, at_once));
    arrived_.add(session);
    sessions_[session->line()] = session;
    return session->line();
  }
  std::uint64_t received(LineId line) const { return cell_.bytes_in(line).value_or(0); }

  std::vector<LineId> woken_;
  std::map<LineId, std::shared_ptr<LineSession>> sessions_;
  ArrivedBytes arrived_{[this](LineId line) { woken_.push_back(line); }};
};

TEST_F(ArrivedBytesTest, AllBytesOfALineAct) {
  const LineId line = add(100'000);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(line), 100'000U);
  EXPECT_TRUE(woken_.empty());
}

TEST_F(ArrivedBytesTest, ReadsOnIfABurstArrivesInParts) {
  const LineId line = add(100'000, 1000);
  arrived_.read(kNever);
  EXPECT_EQ(received(line), 100'000U);
}

TEST_F(ArrivedBytesTest, AFloodEndsAtItsLimit) {
  const LineId line = add(kFlood);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(line), LineSession::kMaxArrived);
  EXPECT_EQ(woken_, std::vector{line}) << "the rest acts in the turns of the line";
}

TEST_F(ArrivedBytesTest, ManyFloodsEndAtTheLimitOfAll) {
  constexpr std::size_t kFloods = 2000;
  std::vector<LineId> floods;
  while (floods.size() < kFloods) floods.push_back(add(kFlood));
  const LineId other = add(1000);
  EXPECT_FALSE(arrived_.read(kNever));
  for (const LineId flood : floods) ASSERT_EQ(received(flood), ArrivedBytes::kRound);
  EXPECT_EQ(received(other), 1000U) << "each line has a round";
  EXPECT_EQ(woken_, floods);
}

TEST_F(ArrivedBytesTest, ReadsAPieceAtATime) {
  const LineId flood = add(kFlood);
  const LineId other = add(1000);
  EXPECT_TRUE(arrived_.read(kPast));
  EXPECT_EQ(received(flood), ArrivedBytes::kRound);
  EXPECT_EQ(received(other), 0U);
  EXPECT_TRUE(arrived_.read(kPast));
  EXPECT_EQ(received(other), 1000U);
}

TEST_F(ArrivedBytesTest, ALineMayEndBetweenTwoPieces) {
  const LineId closed = add(kFlood);
  const LineId destroyed = add(kFlood);
  const LineId other = add(1000);
  sessions_[closed]->close(LineCloseReason::kDisconnected);
  sessions_.erase(destroyed);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(other), 1000U);
  EXPECT_TRUE(woken_.empty());
}

}  // namespace
}  // namespace xr3
