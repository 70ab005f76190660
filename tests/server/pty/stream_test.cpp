// A pseudo-terminal as the stream of a line, with its thread.
#include "server/pty/stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <future>
#include <optional>

#include "tests/server/pty/slave.hpp"

namespace xr3 {
namespace {

using test::Slave;
using Stage = PtyPlace::Stage;

class PtyStreamTest : public testing::Test {
 protected:
  PtyStreamTest() {
    program_.emplace(place_.path());
    EXPECT_TRUE(
        test::await(watch_.news().descriptor(), [&] { return place_.stage() == Stage::kArrived; }));
    stream_.emplace(watch_);
  }

  /// Reads until this many bytes have come, or the end.
  std::string read(std::size_t count) {
    std::string all;
    std::array<char, 16> bytes{};
    EXPECT_TRUE(test::await(stream_->descriptor(), [&] {
      std::size_t got = bytes.size();
      while (got == bytes.size()) {
        got = stream_->read(bytes);
        all.append(bytes.data(), got);
      }
      return all.size() >= count || stream_->has_ended();
    }));
    return all;
  }

  test::PtyFolder folder_;
  PtyWatch watch_{folder_.file("rhino"), 0600};
  PtyPlace& place_ = watch_.place();
  std::optional<Slave> program_;
  std::optional<PtyStream> stream_;
};

TEST_F(PtyStreamTest, CarriesBytesBothWays) {
  program_->write("E?");
  EXPECT_EQ(read(2), "E?");
  EXPECT_EQ(stream_->write(" "), 1U);
  EXPECT_EQ(program_->read(), " ");
}

TEST_F(PtyStreamTest, ReadsTheLastBytesBeforeTheEnd) {
  const std::string bytes(1000, 'E');
  program_->write(bytes);
  program_.reset();
  EXPECT_EQ(read(std::string::npos), bytes);
  EXPECT_TRUE(stream_->has_ended());
  EXPECT_FALSE(stream_->is_lost());
}

TEST_F(PtyStreamTest, DiscardsRepliesToNobody) {
  program_.reset();
  EXPECT_EQ(stream_->write("reply"), 5U);
  EXPECT_EQ(read(1), "");
  EXPECT_EQ(stream_->write("reply"), 5U);
}

TEST_F(PtyStreamTest, EndsAlthoughNobodyHasReadItsReplies) {
  const std::string replies(1024, ' ');
  while (stream_->write(replies) > 0) {
  }
  program_->write("E?");
  program_.reset();
  ASSERT_TRUE(test::await(stream_->descriptor(), [&] { return stream_->is_hung_up(); }));
  EXPECT_EQ(stream_->write(replies), replies.size()) << "discarded";
  EXPECT_EQ(read(std::string::npos), "E?");
  EXPECT_TRUE(stream_->has_ended());
}

TEST_F(PtyStreamTest, IsHungUpBeforeItsBytesAreRead) {
  program_->write("E?");
  EXPECT_FALSE(stream_->is_hung_up());
  program_.reset();
  EXPECT_TRUE(test::await(stream_->descriptor(), [&] { return stream_->is_hung_up(); }));
  EXPECT_FALSE(stream_->has_ended());
}

TEST_F(PtyStreamTest, WritesAgainWhenThereIsRoom) {
  const std::string replies(1024, ' ');
  std::size_t written = 0;
  for (std::size_t count = 1; count > 0; written += count) count = stream_->write(replies);
  EXPECT_EQ(stream_->write("x"), 0U);
  std::size_t taken = 0;
  while (taken < written) taken += program_->read().size();
  EXPECT_TRUE(test::await(stream_->descriptor(), [&] { return stream_->write("x") == 1; }));
  EXPECT_EQ(program_->read(), "x");
}

TEST_F(PtyStreamTest, DoesNotWaitForTheThread) {
  program_->write("E?");
  ASSERT_TRUE(test::await(stream_->descriptor(), [&] { return place_.terminal().has_bytes(); }));
  std::array<char, 16> bytes{};
  {
    const auto use = place_.try_use();
    ASSERT_TRUE(use);
    const auto other = [&](auto call) { return std::async(std::launch::async, call).get(); };
    EXPECT_EQ(other([&] { return stream_->read(bytes); }), 0U);
    EXPECT_EQ(other([&] { return stream_->write(" "); }), 0U);
    EXPECT_FALSE(stream_->has_ended());
  }
  EXPECT_EQ(stream_->read(bytes), 2U);
}

TEST_F(PtyStreamTest, TakesSettingsThatHaveChanged) {
  const auto begin = stream_->take_settings(3);
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->line, 3U);
  EXPECT_EQ(begin->settings.baud, 9600U);
  EXPECT_FALSE(begin->is_cooked);
  EXPECT_FALSE(stream_->take_settings(3)) << "nothing has changed";
  program_->set(B1200, ICANON);
  EXPECT_FALSE(stream_->take_settings(3)) << "no byte has come with them";
  program_->write("E?\n");
  EXPECT_EQ(read(3), "E?\n");
  const auto changed = stream_->take_settings(3);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->settings.baud, 1200U);
  EXPECT_TRUE(changed->is_cooked);
}

TEST_F(PtyStreamTest, TheLastBytesHaveTheSettingsOfTheirProgram) {
  program_->set(B1200, 0);
  program_->write("E?");
  program_.reset();
  EXPECT_EQ(read(std::string::npos), "E?");
  ASSERT_TRUE(stream_->has_ended());
  const auto settings = stream_->take_settings(3);
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->settings.baud, 1200U);
}

TEST_F(PtyStreamTest, HasNoDescriptorWhenClosed) {
  EXPECT_TRUE(stream_->is_open());
  stream_->close();
  EXPECT_FALSE(stream_->is_open());
}

}  // namespace
}  // namespace xr3
