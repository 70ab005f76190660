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

/// Gives a flood, or notes that it is read and gives nothing.
class NotedStream final : public LineStream {
 public:
  /// `read`: nullptr for a flood.
  explicit NotedStream(std::function<void()> read) : read_(std::move(read)) {}
  NotedStream(const NotedStream&) = delete;
  NotedStream& operator=(const NotedStream&) = delete;
  ~NotedStream() override { ::close(descriptor_); }

  int descriptor() const override { return is_closed_ ? -1 : descriptor_; }
  std::size_t read(std::span<char> into) override {
    if (read_) return read_(), 0;
    std::ranges::fill(into, '\r');
    return into.size();
  }
  std::size_t write(std::string_view bytes) override { return bytes.size(); }
  void close() override { is_closed_ = true; }

 private:
  std::function<void()> read_;
  bool is_closed_ = false;
  int descriptor_ = ::eventfd(0, EFD_CLOEXEC);
};

class LineTurnsTest : public test::LineFixture {
 protected:
  LineTurnsTest() {
    // A flood has had a turn, or more of it.
    context_.on_input = [this](LineId line) { note(line); };
  }
  ~LineTurnsTest() override {
    for (const auto& [line, number] : numbers_) turns_.remove(number);
    turns_.close();
    io_.run();
  }

  /// Lines are numbered from 1.
  void add(bool is_flood) {
    const auto line = static_cast<LineId>(numbers_.size() + 1);
    auto read = is_flood ? std::function<void()>() : [line, this] { note(line); };
    sessions_[line] = open(std::make_unique<NotedStream>(std::move(read)));
    numbers_[line] = turns_.add(sessions_[line]).value();
  }
  void wake(LineId line) { turns_.wake(numbers_[line]); }
  void note(LineId line) {
    if (turns_of_.empty() || turns_of_.back() != line) turns_of_.push_back(line);
  }

  std::vector<LineId> turns_of_;  ///< in order
  std::map<LineId, SessionNumber> numbers_;
  std::map<LineId, std::shared_ptr<LineSession>> sessions_;
};

TEST_F(LineTurnsTest, LinesHaveTurnsInTheOrderOfTheirNews) {
  for (LineId line = 1; line <= 3; ++line) add(false);
  for (const LineId line : {3U, 1U, 2U}) wake(line);
  turns_.run_turns();
  EXPECT_EQ(turns_of_, (std::vector<LineId>{3, 1, 2}));
}

TEST_F(LineTurnsTest, ALineWaitsOnce) {
  for (LineId line = 1; line <= 2; ++line) add(false);
  for (const LineId line : {1U, 2U, 1U}) wake(line);
  turns_.run_turns();
  EXPECT_EQ(turns_of_, (std::vector<LineId>{1, 2}));
}

TEST_F(LineTurnsTest, LinesWithNewsAndBusyLinesHaveTurnsAlternately) {
  constexpr LineId kFloods = 3;
  for (LineId line = 1; line <= kFloods; ++line) add(true);
  for (LineId line = 1; line <= kFloods; ++line) turns_.run_turn(numbers_[line]);  // busy from here
  for (LineId line = kFloods + 1; line <= 2 * kFloods; ++line) add(false);
  for (LineId line = kFloods + 1; line <= 2 * kFloods; ++line) wake(line);
  turns_of_.clear();
  while (turns_of_.size() < 2 * kFloods) turns_.run_turns();
  turns_of_.resize(2 * kFloods);
  EXPECT_EQ(turns_of_, (std::vector<LineId>{4, 1, 5, 2, 6, 3}));
}

TEST_F(LineTurnsTest, BusyLinesHaveTurnsInTurn) {
  for (LineId line = 1; line <= 3; ++line) add(true);
  for (LineId line = 1; line <= 3; ++line) turns_.run_turn(numbers_[line]);  // busy from here
  turns_of_.clear();
  while (turns_of_.size() < 6) turns_.run_turns();
  turns_of_.resize(6);
  EXPECT_EQ(turns_of_, (std::vector<LineId>{1, 2, 3, 1, 2, 3}));
}

TEST_F(LineTurnsTest, AClosedSessionHasNoTurn) {
  for (LineId line = 1; line <= 2; ++line) add(false);
  for (LineId line = 1; line <= 2; ++line) wake(line);
  turns_.remove(numbers_[1]);
  turns_.run_turns();
  EXPECT_EQ(turns_of_, (std::vector<LineId>{2}));
}

}  // namespace
}  // namespace xr3
