// The stream of a pseudo-terminal's line, without the thread: the test writes to the socket pair.
#include "server/pty/stream.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>

namespace xr3 {
namespace {

class PtyStreamTest : public testing::Test {
 protected:
  PtyStreamTest() {
    std::array<int, 2> pair{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair.data()), 0);
    thread_ = Descriptor(pair[0]);
    shared_.changes = {{0, {9600, false}}};
    stream_.emplace(Descriptor(pair[1]), shared_, progress_);
  }

  void write(const std::string& bytes) const {
    ASSERT_EQ(::write(thread_.get(), bytes.data(), bytes.size()), std::ssize(bytes));
  }
  std::string read() {
    std::array<char, 16> bytes{};
    return {bytes.data(), stream_->read(bytes)};
  }
  /// The speed that is reported now; 0: none.
  std::uint32_t speed() {
    const auto settings = stream_->changed_settings(3);
    return settings ? settings->settings.baud : 0;
  }

  PtyShared shared_;
  std::uint64_t progress_ = 0;
  Descriptor thread_;
  std::optional<PtyStream> stream_;
};

TEST_F(PtyStreamTest, CarriesBytesBothWays) {
  write("E?");
  EXPECT_EQ(read(), "E?");
  EXPECT_EQ(progress_, 1U);
  EXPECT_EQ(read(), "");
  EXPECT_EQ(progress_, 1U) << "nothing was read";
  EXPECT_EQ(stream_->write(" "), 1U);
  char reply = 0;
  EXPECT_EQ(::read(thread_.get(), &reply, 1), 1);
  EXPECT_EQ(reply, ' ');
}

TEST_F(PtyStreamTest, EndsWhenTheThreadWritesNoMore) {
  write("E?");
  ::shutdown(thread_.get(), SHUT_WR);
  EXPECT_EQ(read(), "E?");
  EXPECT_FALSE(stream_->has_ended());
  EXPECT_EQ(read(), "");
  EXPECT_TRUE(stream_->has_ended());
  EXPECT_EQ(stream_->write(" "), 1U) << "the thread discards it";
}

TEST_F(PtyStreamTest, BeginsWithTheSettingsOfTheFirstByte) {
  const auto begin = stream_->changed_settings(3);
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->line, 3U);
  EXPECT_EQ(begin->settings.baud, 9600U);
  EXPECT_FALSE(begin->is_cooked);
  EXPECT_EQ(speed(), 0U) << "nothing has changed";
}

TEST_F(PtyStreamTest, BytesHaveTheSettingsWithWhichTheyCame) {
  speed();
  shared_.changes = {{2, {1200, true}}, {5, {300, false}}};
  write("E?F?\nG?");
  EXPECT_EQ(read(), "E?");
  EXPECT_EQ(speed(), 0U);
  EXPECT_TRUE(stream_->has_more());
  EXPECT_EQ(read(), "F?\n");
  const auto second = stream_->changed_settings(3);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->settings.baud, 1200U);
  EXPECT_TRUE(second->is_cooked);
  EXPECT_EQ(read(), "G?");
  EXPECT_EQ(speed(), 300U);
  EXPECT_FALSE(stream_->has_more());
  EXPECT_TRUE(shared_.changes.empty());
}

TEST_F(PtyStreamTest, OfSettingsWithoutAByteTheLastOnesCount) {
  speed();
  shared_.changes = {{0, {1200, false}}, {0, {300, false}}};
  write("E?");
  EXPECT_EQ(read(), "E?");
  EXPECT_EQ(speed(), 300U);
}

TEST_F(PtyStreamTest, ASpeedOfZeroIsNone) {
  speed();
  shared_.changes = {{0, {0, false}}};
  write("E?");
  EXPECT_EQ(read(), "E?");
  EXPECT_EQ(speed(), 0U);
}

}  // namespace
}  // namespace xr3
