#include "server/lines/turns.hpp"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <map>
#include <vector>

#include "tests/support/line_sessions.hpp"

namespace xr3 {
namespace {

/// Notes that it is read, and gives nothing.
class NotedStream final : public LineStream {
 public:
  explicit NotedStream(std::function<void()> read) : read_(std::move(read)) {}
  NotedStream(const NotedStream&) = delete;
  NotedStream& operator=(const NotedStream&) = delete;
  ~NotedStream() override { ::close(descriptor_); }

  int descriptor() const override { return descriptor_; }
  std::size_t read(std::span<char>) override {
    read_();
    return 0;
  }
  std::size_t write(std::string_view bytes) override { return bytes.size(); }
  void close() override {}

 private:
  std::function<void()> read_;
  int descriptor_ = ::eventfd(0, EFD_CLOEXEC);
};

class LineTurnsTest : public test::LineSessionsTest {
 protected:
  ~LineTurnsTest() override {
    for (const auto& [line, number] : numbers_) turns_.remove(number);
    turns_.close();
    io_.run();
  }

  /// Lines are numbered from 1. nullptr: it has no address.
  void add(const char* address) {
    auto place = address == nullptr
                     ? nullptr
                     : std::make_shared<const asio::ip::address>(asio::ip::make_address(address));
    const LineId line = static_cast<LineId>(numbers_.size() + 1);
    auto stream = std::make_unique<NotedStream>([line, this] { read_.push_back(line); });
    const auto session = open(std::move(stream), std::move(place));
    ASSERT_EQ(session->line(), line);
    numbers_[line] = turns_.add(session).value();
  }

  /// All lines wait for a turn, in the order of their numbers; returns the order of their turns.
  const std::vector<LineId>& order() {
    for (const auto& [line, number] : numbers_) turns_.wake(number);
    for (std::size_t turn = 0; turn < numbers_.size(); ++turn) turns_.run_turns();
    return read_;
  }

  std::vector<LineId> read_;
  std::map<LineId, SessionNumber> numbers_;
};

TEST_F(LineTurnsTest, AddressesTakeTurns) {
  for (int line = 1; line <= 4; ++line) add("192.0.2.1");
  add("192.0.2.2");
  EXPECT_EQ(order(), (std::vector<LineId>{1, 5, 2, 3, 4}));
}

TEST_F(LineTurnsTest, LinesWithoutAnAddressTakeTurnsWithAllOthers) {
  for (int line = 1; line <= 3; ++line) add("192.0.2.1");
  for (int line = 1; line <= 3; ++line) add(nullptr);
  EXPECT_EQ(order(), (std::vector<LineId>{1, 4, 5, 6, 2, 3}));
}

}  // namespace
}  // namespace xr3
