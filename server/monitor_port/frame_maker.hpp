// Makes the frames of the latest-wins channels: those of a small cell at once, those of a large one
// in the worker, so that nobody else waits for them.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "cell/frames.hpp"
#include "protocol/monitor/subscription.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/worker.hpp"

namespace xr3 {

/// A selection, and its frame at some moment: nullopt for an image if there is no camera.
using SelectedFrame = std::pair<monitor::Selection, std::optional<monitor::Frame>>;

class FrameMaker {
 public:
  /// The JSON of a cell with more blocks is made in the worker. A block takes some 10 us.
  static constexpr std::size_t kMaxBlocksAtOnce = 50;

  /// The references must outlive it.
  FrameMaker(asio::io_context& io, Cell& cell, Worker& worker)
      : cell_(cell), worker_(worker), making_(io) {}

  /// Whether the frames of a channel come from the worker now.
  bool is_slow(monitor::Channel channel) const;
  /// Whether those of any channel do.
  bool is_any_slow() const;

  /// The current frame, valid until the next call; nullptr for an image if there is no camera.
  /// Precondition: !is_slow(selection.channel).
  const monitor::Frame* at_once(const monitor::Selection& selection);

  /// The frame as of a moment after this call; nullopt for an image if there is no camera.
  asio::awaitable<std::optional<monitor::Frame>> get(monitor::Selection selection);

  /// Discards frames that can be made again, unless the worker is making some. Returns their bytes.
  std::size_t trim() { return frames_ && !making_.is_held() ? frames_->trim() : 0; }

  /// Makes the frames of some selections in the worker, all as of one moment after this call.
  asio::awaitable<std::vector<SelectedFrame>> make(std::vector<monitor::Selection> selections);

 private:
  FrameCache& frames();
  std::vector<FrameSource> new_sources(const std::vector<monitor::Selection>& selections);

  Cell& cell_;
  Worker& worker_;
  /// Accessed by the worker only while making_ is held, else by the loop only. Made when the first
  /// frame is asked for, since most cells are not watched.
  std::unique_ptr<FrameCache> frames_;
  Exclusive making_;
};

}  // namespace xr3
