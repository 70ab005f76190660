#include "cell/frames.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/json/source.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using monitor::Channel;
using monitor::Selection;

constexpr WallNs kNow = 0;

class FrameCacheTest : public testing::Test {
 protected:
  static std::string text_of(const monitor::Frame* frame) {
    return frame == nullptr ? "none" : *frame->message;
  }
  std::string get(const Selection& selection) { return text_of(frames_.frame(selection)); }
  void apply(const call::Call& call) { cell_.apply(call, kNow); }

  Cell cell_{"main", test::rhino(), SimClock::manual(), nullptr};
  FrameCache frames_{cell_};
};

constexpr Channel kChannels[] = {Channel::kState, Channel::kImage, Channel::kDisplay,
                                 Channel::kModel};

TEST_F(FrameCacheTest, CachesOfOneCellMakeEqualFrames) {
  FrameCache other(cell_);
  for (const Channel channel : kChannels)
    EXPECT_EQ(get({channel, {}, {}}), text_of(other.frame({channel, {}, {}})));
}

TEST_F(FrameCacheTest, CountsChangesAndKeepsUnchangedFrames) {
  const Selection state{Channel::kState, {}, {}};
  const monitor::Message first = frames_.frame(state)->message;
  EXPECT_EQ(frames_.frame(state)->message, first);
  apply(call::Step{1});
  const Json second = Json::parse(get(state));
  EXPECT_EQ(second["seq"], 2);
  EXPECT_EQ(second["tick"], 1);
}

TEST_F(FrameCacheTest, SelectionsOfOneStateHaveOneSeq) {
  const std::int64_t seq = frames_.frame({Channel::kState, {}, {}})->seq;
  EXPECT_EQ(frames_.frame({Channel::kState, Fields{{"joints"}}, {}})->seq, seq);
  EXPECT_EQ(Json::parse(get({Channel::kState, Fields{{"joints"}}, {}})).count("blocks"), 0U);
}

TEST_F(FrameCacheTest, AfterTrimmingTheFramesAreMadeAgain) {
  const std::string before = get({Channel::kState, {}, {}});
  EXPECT_EQ(frames_.trim(), before.size());
  EXPECT_EQ(frames_.trim(), 0U);
  EXPECT_EQ(get({Channel::kState, {}, {}}), before);
}

TEST_F(FrameCacheTest, HasNoImageWithoutACamera) {
  Workcell cell = test::workcell_named("rhino-xr3");
  cell.camera.reset();
  apply(call::ReplaceWorkcell{cell});
  EXPECT_EQ(get({Channel::kImage, {}, {}}), "none");
}

}  // namespace
}  // namespace xr3
