#include "server/monitor_port/frame_maker.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "protocol/json/source.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using monitor::Channel;
using monitor::Frame;
using monitor::Selection;

constexpr WallNs kNow = 0;

ModelPtr model_with(const std::string& workcell, int pixels = 0) {
  Workcell cell = test::workcell_named(workcell);
  if (pixels > 0) cell.camera->pixels_x = cell.camera->pixels_y = pixels;
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"), std::move(cell),
                                       Profile::kPaper);
}

class FrameMakerTest : public testing::Test {
 protected:
  explicit FrameMakerTest(const std::string& workcell = "rhino-xr3", int pixels = 0)
      : cell_("main", model_with(workcell, pixels), SimClock::manual(), nullptr) {}

  /// Runs the loop until nothing waits any more. A quick worker may have ended it in a poll.
  void run() {
    io_.restart();
    io_.run();
  }
  /// Runs the loop until a frame is there.
  std::string get(const Selection& selection) {
    std::optional<Frame> got;
    start(selection, got);
    run();
    return got ? *got->message : "none";
  }
  void start(const Selection& selection, std::optional<Frame>& got) {
    const auto wait = [this, selection, &got]() -> asio::awaitable<void> {
      std::optional<Frame> frame = co_await frames_.get(selection);
      got = std::move(frame);
    };
    asio::co_spawn(io_, wait, asio::detached);
  }
  /// The same frame, encoded in this thread by another cache.
  std::string expected(const Selection& selection) {
    FrameCache cache(cell_.name());
    cache.show(frame_source(cell_, selection.channel));
    return *cache.frame(selection)->message;
  }
  void move() { cell_.apply(call::Call(call::Step{1}), kNow); }

  asio::io_context io_;
  Cell cell_;
  Worker worker_;
  FrameMaker frames_{io_, cell_, worker_};
};

struct LargeFrameMakerTest : FrameMakerTest {
  LargeFrameMakerTest() : FrameMakerTest("rhino-hundred", 512) {}
};

constexpr Channel kChannels[] = {Channel::kState, Channel::kImage, Channel::kDisplay,
                                 Channel::kModel};

TEST_F(FrameMakerTest, MakesTheFramesOfASmallCellAtOnce) {
  EXPECT_FALSE(frames_.is_any_slow());
  for (const Channel channel : kChannels) {
    ASSERT_FALSE(frames_.is_slow(channel));
    EXPECT_EQ(*frames_.at_once({channel, {}, {}})->message, expected({channel, {}, {}}));
    EXPECT_EQ(get({channel, {}, {}}), expected({channel, {}, {}}));
  }
}

TEST_F(LargeFrameMakerTest, MakesTheFramesOfALargeCellInTheWorker) {
  EXPECT_TRUE(frames_.is_any_slow());
  for (const Channel channel : kChannels) {
    EXPECT_TRUE(frames_.is_slow(channel));
    EXPECT_EQ(get({channel, {}, {}}), expected({channel, {}, {}}));
  }
}

TEST_F(LargeFrameMakerTest, CountsChangesAndKeepsUnchangedFrames) {
  const Selection state{Channel::kState, {}, {}};
  const std::string first = get(state);
  EXPECT_EQ(get(state), first);
  move();
  const Json second = Json::parse(get(state));
  EXPECT_EQ(second["seq"], 2);
  EXPECT_EQ(second["tick"], 1);
}

TEST_F(LargeFrameMakerTest, AnswersAllWhoWaitWithAFrameOfAtLeastTheirTime) {
  std::optional<Frame> early;
  std::optional<Frame> late;
  std::optional<Frame> other;
  start({Channel::kState, {}, {}}, early);
  io_.poll();
  move();
  start({Channel::kState, {}, {}}, late);
  start({Channel::kState, Fields{{"tick", "holding"}}, {}}, other);
  run();
  ASSERT_TRUE(early && late && other);
  EXPECT_EQ(Json::parse(*early->message)["tick"], 0);
  EXPECT_EQ(Json::parse(*late->message)["tick"], 1);
  EXPECT_EQ(other->seq, late->seq);
  EXPECT_LT(other->message->size(), late->message->size());
}

TEST_F(LargeFrameMakerTest, IsSlowWhileTheWorkerIsAtWork) {
  std::optional<Frame> got;
  start({Channel::kState, {}, {}}, got);
  io_.poll_one();
  cell_.apply(call::Call(call::ReplaceWorkcell{test::workcell_named("rhino-xr3")}), kNow);
  EXPECT_TRUE(frames_.is_slow(Channel::kState));
  run();
  EXPECT_FALSE(frames_.is_slow(Channel::kState));
  EXPECT_EQ(Json::parse(get({Channel::kState, {}, {}}))["blocks"].size(), 5U);
}

TEST_F(LargeFrameMakerTest, HasNoImageWithoutACamera) {
  Workcell cell = test::workcell_named("rhino-hundred");
  cell.camera.reset();
  cell_.apply(call::Call(call::ReplaceWorkcell{cell}), kNow);
  EXPECT_EQ(get({Channel::kImage, {}, {}}), "none");
}

}  // namespace
}  // namespace xr3
