#include "server/lines/arrived.hpp"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <map>

#include "tests/support/line_sessions.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kFlood = std::numeric_limits<std::size_t>::max();
constexpr WallNs kPast = 0;
/// A turn may begin with bytes that the one before has read.
constexpr std::size_t kLastTurn = 2 * LineSession::kBytesATurn;

/// Gives a number of CRs, of which `shown` at most have arrived at once; takes all replies.
class CrStream final : public LineStream {
 public:
  CrStream(std::size_t count, std::size_t shown, std::size_t max_settled)
      : left_(count), shown_(shown), max_settled_(max_settled) {}
  CrStream(const CrStream&) = delete;
  CrStream& operator=(const CrStream&) = delete;
  ~CrStream() override { ::close(descriptor_); }

  int descriptor() const override { return is_closed_ ? -1 : descriptor_; }
  std::size_t unread_bytes() const override { return std::min(left_, shown_); }
  std::size_t max_settled() const override { return max_settled_; }
  std::size_t read(std::span<char> into) override {
    const std::size_t count = std::min(into.size(), left_);
    std::ranges::fill(into.first(count), '\r');
    left_ -= count;
    return count;
  }
  std::size_t write(std::string_view bytes) override { return bytes.size(); }
  void close() override { is_closed_ = true; }

 private:
  std::size_t left_;
  std::size_t shown_;
  std::size_t max_settled_;
  bool is_closed_ = false;
  int descriptor_ = ::eventfd(0, EFD_CLOEXEC);
};

class ArrivedBytesTest : public test::LineFixture {
 protected:
  ~ArrivedBytesTest() override {
    for (const auto& [line, number] : numbers_) turns_.remove(number);
    turns_.close();
    io_.run();
  }

  /// Line 1 is the first one.
  LineId add(std::size_t count, std::size_t shown = kFlood, std::size_t max_settled = kFlood) {
    const auto session = open(std::make_unique<CrStream>(count, shown, max_settled));
    sessions_[session->line()] = session;
    numbers_[session->line()] = turns_.add(session).value();
    arrived_.add(numbers_[session->line()], session);
    return session->line();
  }
  std::uint64_t received(LineId line) const { return cell_.bytes_in(line).value_or(0); }

  std::map<LineId, std::shared_ptr<LineSession>> sessions_;
  std::map<LineId, SessionNumber> numbers_;
  ArrivedBytes arrived_{turns_};
};

TEST_F(ArrivedBytesTest, AllBytesThatHaveArrivedAreExecuted) {
  const LineId line = add(100'000);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(line), 100'000U);
}

TEST_F(ArrivedBytesTest, ReadsOnIfABurstArrivesInParts) {
  const LineId line = add(100'000, 8192);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(line), 100'000U);
}

TEST_F(ArrivedBytesTest, BytesThatArriveLaterAreNotWaitedFor) {
  const LineId line = add(kFlood, 10);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_GE(received(line), 10U);
  EXPECT_LE(received(line), kFirstChunk) << "one turn";
}

TEST_F(ArrivedBytesTest, AFloodEndsAtItsLimit) {
  const LineId line = add(kFlood);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_GE(received(line), ArrivedBytes::kMaxBytes);
  EXPECT_LE(received(line), ArrivedBytes::kMaxBytes + kLastTurn);
}

TEST_F(ArrivedBytesTest, AFloodThatRefillsItsStreamEndsAtTheBoundOfTheStream) {
  const LineId line = add(kFlood, kFlood, /*max_settled=*/8192);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_GE(received(line), 8192U);
  EXPECT_LE(received(line), 8192 + kLastTurn);
}

TEST_F(ArrivedBytesTest, LinesHaveTurnsOneAfterTheOther) {
  const LineId flood = add(kFlood);
  const LineId other = add(1000);
  EXPECT_TRUE(arrived_.read(kPast));
  EXPECT_GT(received(flood), 0U);
  EXPECT_EQ(received(other), 0U);
  EXPECT_TRUE(arrived_.read(kPast));
  EXPECT_GT(received(other), 0U);
}

TEST_F(ArrivedBytesTest, ALineMayEndBetweenTwoTurns) {
  const LineId closed = add(kFlood);
  const LineId destroyed = add(kFlood);
  const LineId other = add(1000);
  sessions_[closed]->close(LineCloseReason::kDisconnected);
  turns_.remove(numbers_[destroyed]);
  sessions_.erase(destroyed);
  EXPECT_FALSE(arrived_.read(kNever));
  EXPECT_EQ(received(other), 1000U);
}

}  // namespace
}  // namespace xr3
