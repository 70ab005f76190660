#include "server/lines/sessions.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/models.hpp"
#include "tests/support/scripted_stream.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;
using test::accepts;
using test::is_full;
using test::reads;
using test::reads_end;
using test::StreamStep;

/// Notes the lines that have ended, and opens the next line when new clients are asked for.
struct NotingSource final : LineSource {
  void accept_arrived() override {
    if (auto accept = std::exchange(accept_next, nullptr)) accept();
  }
  void line_ended(LineId line, LineCloseReason reason) override {
    ended.emplace_back(line, reason);
  }
  PortCounters counters() const override { return {1, 2, 3}; }

  std::function<void()> accept_next;
  std::vector<std::pair<LineId, LineCloseReason>> ended;
};

class LineSessionsTest : public testing::Test {
 protected:
  LineSessionsTest() { lines_.add(source_); }
  ~LineSessionsTest() override {
    lines_.abort();
    turns_.close();
    io_.restart();
    io_.run();
  }

  LineId open(std::deque<StreamStep> script) {
    return lines_
        .open(source_, std::make_unique<test::ScriptedStream>(std::move(script)), LineOpened{})
        .value();
  }
  void read_arrived() {
    bool is_done = false;
    asio::co_spawn(io_, lines_.read_arrived(), [&is_done](const auto&) { is_done = true; });
    while (!is_done) io_.run_one();
  }
  void begin_to_wait(LineId line, std::uint64_t bytes, milliseconds within) {
    asio::co_spawn(io_, lines_.wait_for_bytes(line, bytes, within),
                   [this](const auto&, bool has_come) { has_come_ = has_come; });
  }
  bool wait() {
    while (!has_come_) io_.run_one();
    return *has_come_;
  }
  std::uint64_t received(LineId line) const { return cell_.bytes_in(line).value_or(0); }

  asio::io_context io_{1};
  LineTurns turns_{io_};
  Cell cell_{"main", test::rhino(), SimClock::manual()};
  LineSessions lines_{turns_, cell_, [] {}};
  NotingSource source_;
  std::optional<bool> has_come_;
};

TEST_F(LineSessionsTest, ALineIsServedWithoutACall) {
  const LineId line = open({reads("E?"), accepts(" ")});
  while (received(line) == 0) io_.run_one();
  EXPECT_EQ(received(line), 2U);
}

TEST_F(LineSessionsTest, BytesAndClientsThatHaveArrivedAreReadBeforeACall) {
  LineId second = 0;
  source_.accept_next = [&] { second = open({reads("F+5\rF?"), accepts("%")}); };
  const LineId first = open({reads("E?"), accepts(" ")});
  read_arrived();
  EXPECT_EQ(received(first), 2U);
  EXPECT_EQ(received(second), 6U);
}

TEST_F(LineSessionsTest, AWaitEndsWhenTheBytesHaveCome) {
  const LineId line = open({reads("E+5\r")});
  begin_to_wait(line, 4, std::chrono::hours(1));
  EXPECT_TRUE(wait());
}

TEST_F(LineSessionsTest, AWaitEndsAtItsDeadlineOrWithItsLine) {
  const LineId line = open({});
  begin_to_wait(line, 1, milliseconds(1));
  EXPECT_FALSE(wait());
  has_come_.reset();
  begin_to_wait(line, 1, std::chrono::hours(1));
  io_.poll();
  lines_.disconnect(line);
  EXPECT_FALSE(wait());
}

TEST_F(LineSessionsTest, ALineIsDisconnectedOnce) {
  const LineId line = open({});
  EXPECT_TRUE(lines_.disconnect(line));
  EXPECT_FALSE(lines_.disconnect(line));
  EXPECT_EQ(source_.ended, (std::vector{std::pair(line, LineCloseReason::kDisconnected)}));
  EXPECT_TRUE(lines_.is_empty());
}

TEST_F(LineSessionsTest, AStreamThatHasEndedClosesItsLine) {
  const LineId line = open({reads("E?"), accepts(" "), reads_end()});
  read_arrived();
  lines_.wake(line);
  io_.restart();
  while (!lines_.is_empty()) io_.run_one();
  EXPECT_EQ(source_.ended, (std::vector{std::pair(line, LineCloseReason::kClientClosed)}));
}

TEST_F(LineSessionsTest, AtTheEndALineWaitsForItsClientUntilTheDeadline) {
  open({reads("E?"), accepts(" ")});
  const LineId unread = open({reads("E?"), is_full()});
  read_arrived();
  lines_.close();
  EXPECT_EQ(source_.ended.size(), 1U);
  lines_.close(/*deadline=*/0);
  EXPECT_EQ(source_.ended.back(), std::pair(unread, LineCloseReason::kShutdown));
  EXPECT_TRUE(lines_.is_empty());
}

TEST_F(LineSessionsTest, CountersOfAllSourcesAreAdded) {
  NotingSource other;
  lines_.add(other);
  EXPECT_EQ(lines_.counters().refused, 2U);
  EXPECT_EQ(lines_.counters().accept_failures, 4U);
}

}  // namespace
}  // namespace xr3
