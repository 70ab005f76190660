#include "server/lines/turns.hpp"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <vector>

#include "tests/support/line_sessions.hpp"

namespace xr3 {
namespace {

/// Notes each read, and gives a flood or nothing.
class NotedStream final : public LineStream {
 public:
  NotedStream(std::function<void()> read, bool is_flood)
      : read_(std::move(read)), is_flood_(is_flood) {}
  NotedStream(const NotedStream&) = delete;
  NotedStream& operator=(const NotedStream&) = delete;
  ~NotedStream() override { ::close(descriptor_); }

  int descriptor() const override { return is_closed_ ? -1 : descriptor_; }
  std::size_t read(std::span<char> into) override {
    read_();
    std::ranges::fill(into, '\r');
    return is_flood_ ? into.size() : 0;
  }
  std::size_t write(std::string_view bytes) override { return bytes.size(); }
  void close() override { is_closed_ = true; }

 private:
  std::function<void()> read_;
  bool is_flood_;
  bool is_closed_ = false;
  int descriptor_ = ::eventfd(0, EFD_CLOEXEC);
};

class LineTurnsTest : public test::LineFixture {
 protected:
  ~LineTurnsTest() override {
    for (const auto& [line, number] : numbers_) turns_.remove(number);
    turns_.close();
    io_.run();
  }

  /// Lines are numbered from 1.
  void add(bool is_flood) {
    const auto line = static_cast<LineId>(numbers_.size() + 1);
    sessions_[line] =
        open(std::make_unique<NotedStream>([line, this] { read_.push_back(line); }, is_flood));
    numbers_[line] = turns_.add(sessions_[line]).value();
  }
  void wake(LineId line) { turns_.wake(numbers_[line]); }

  std::vector<LineId> read_;
  std::map<LineId, SessionNumber> numbers_;
  std::map<LineId, std::shared_ptr<LineSession>> sessions_;
};

TEST_F(LineTurnsTest, LinesHaveTurnsInTheOrderOfTheirNews) {
  for (int line = 1; line <= 3; ++line) add(false);
  for (const LineId line : {3, 1, 2}) wake(line);
  turns_.run_turns();
  EXPECT_EQ(read_, (std::vector<LineId>{3, 1, 2}));
}

TEST_F(LineTurnsTest, ALineWaitsOnce) {
  add(false);
  wake(1);
  wake(1);
  turns_.run_turns();
  EXPECT_EQ(read_, (std::vector<LineId>{1}));
}

TEST_F(LineTurnsTest, LinesWithNewsAndBusyLinesHaveTurnsAlternately) {
  constexpr int kFloods = 3;
  for (int line = 1; line <= kFloods; ++line) add(true);
  for (int line = 1; line <= kFloods; ++line) turns_.run_turn(numbers_[line]);  // busy from here
  for (int line = kFloods + 1; line <= 2 * kFloods; ++line) add(false);
  for (int line = kFloods + 1; line <= 2 * kFloods; ++line) wake(line);
  read_.clear();
  while (read_.size() < 2 * kFloods) turns_.run_turns();
  read_.resize(2 * kFloods);
  EXPECT_EQ(read_, (std::vector<LineId>{4, 1, 5, 2, 6, 3}));
}

TEST_F(LineTurnsTest, BusyLinesHaveTurnsInTurn) {
  for (int line = 1; line <= 3; ++line) add(true);
  for (int line = 1; line <= 3; ++line) wake(line);
  while (read_.size() < 6) turns_.run_turns();
  read_.resize(6);
  EXPECT_EQ(read_, (std::vector<LineId>{1, 2, 3, 1, 2, 3}));
}

TEST_F(LineTurnsTest, AClosedSessionHasNoTurn) {
  for (int line = 1; line <= 2; ++line) add(false);
  for (int line = 1; line <= 2; ++line) wake(line);
  turns_.remove(numbers_[1]);
  turns_.run_turns();
  EXPECT_EQ(read_, (std::vector<LineId>{2}));
}

}  // namespace
}  // namespace xr3
