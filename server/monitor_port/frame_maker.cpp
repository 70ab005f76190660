#include "server/monitor_port/frame_maker.hpp"

#include <algorithm>
#include <cassert>

#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using monitor::Channel;
using monitor::Frame;
using monitor::Selection;

// Larger images are made in the worker. 1,000 pixels take some 2 us.
constexpr int kMaxPixelsAtOnce = 256 * 256;

bool is_large_image(const Model& model) {
  const auto& camera = model.workcell().camera;
  return camera && camera->pixels_x * camera->pixels_y > kMaxPixelsAtOnce;
}

/// The frame of a selection, after the sources have been shown.
std::optional<Frame> frame_of(FrameCache& frames, const Selection& selection) {
  const Frame* frame = frames.frame(selection);
  return frame == nullptr ? std::nullopt : std::optional(*frame);
}

}  // namespace

// Display and model are as large as the state.
bool FrameMaker::is_slow(Channel channel) const {
  if (making_.is_held()) return true;
  if (channel == Channel::kImage) return is_large_image(cell_.model());
  return cell_.state().blocks.size() > kMaxBlocksAtOnce;
}

bool FrameMaker::is_any_slow() const {
  return is_slow(Channel::kState) || is_slow(Channel::kImage);
}

FrameCache& FrameMaker::frames() {
  if (!frames_) frames_ = std::make_unique<FrameCache>(cell_.name());
  return *frames_;
}

const Frame* FrameMaker::at_once(const Selection& selection) {
  assert(!is_slow(selection.channel));
  const Channel channel = selection.channel;
  if (!frames().is_current(channel, cell_.revision())) frames_->show(frame_source(cell_, channel));
  return frames_->frame(selection);
}

asio::awaitable<std::optional<Frame>> FrameMaker::get(Selection selection) {
  if (!is_slow(selection.channel)) {
    const Frame* frame = at_once(selection);
    co_return frame == nullptr ? std::nullopt : std::optional(*frame);
  }
  std::vector<Selection> one{std::move(selection)};
  std::vector<SelectedFrame> made = co_await make(std::move(one));
  co_return std::move(made.front().second);
}

asio::awaitable<std::vector<SelectedFrame>> FrameMaker::make(std::vector<Selection> selections) {
  co_await making_.until_free();
  const Exclusive::Hold hold(making_);
  cell_.catch_up(wall_now());
  auto sources = new_sources(selections);
  auto work = [cache = &frames(), sources = std::move(sources), wanted = std::move(selections)] {
    for (const FrameSource& source : sources) cache->show(source);
    std::vector<SelectedFrame> frames;
    for (const Selection& selection : wanted)
      frames.emplace_back(selection, frame_of(*cache, selection));
    return frames;
  };
  std::vector<SelectedFrame> made = co_await worker_.run(std::move(work));
  co_return made;
}

/// The sources of the channels whose frames are older than the cell.
std::vector<FrameSource> FrameMaker::new_sources(const std::vector<Selection>& selections) {
  std::vector<FrameSource> sources;
  for (const Selection& selection : selections) {
    const Channel channel = selection.channel;
    const bool is_known = std::ranges::count(sources, channel, &FrameSource::channel) > 0;
    if (!is_known && !frames().is_current(channel, cell_.revision()))
      sources.push_back(frame_source(cell_, channel));
  }
  return sources;
}

}  // namespace xr3
