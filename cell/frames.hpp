// Caches the current frame of each latest-wins channel. A frame is encoded once for all clients
// with the same selection, and kept until the cell changes. Independent of clients.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "protocol/monitor/subscription.hpp"

namespace xr3 {

class FrameCache {
 public:
  /// The cell must outlive it.
  explicit FrameCache(Cell& cell) : cell_(cell) {}

  /// The current frame of the selection's channel (state, image, display or model), valid until the
  /// next call; nullptr for an image if there is no camera. Frames with equal seq and selection
  /// have equal bytes.
  const monitor::Frame* frame(const monitor::Selection& selection);

  /// Discards the encoded frames, which frame() makes again. Returns the bytes of their messages.
  std::size_t trim();

 private:
  /// The latest frame, encoded for one selection.
  struct EncodedFrame {
    monitor::Selection selection;
    std::int64_t seq = 0;
    monitor::Frame frame;
  };
  /// The content of a `model` message except the robot.
  struct ShownModel {
    int rev = 0;
    Workcell workcell;
    bool operator==(const ShownModel&) const = default;
  };
  /// The latest frame of one channel. `text` and `image` are compared to detect a change.
  struct ChannelCache {
    std::uint64_t revision = 0;  ///< of the cell at the last check
    std::int64_t seq = 0;
    Epoch epoch = 0;
    Tick tick = 0;
    MemberTexts members;
    std::string text;
    std::optional<Snapshot> snapshot;  ///< state only: the content of `text`, with tick 0
    std::optional<ShownModel> model;   ///< model only
    ImagePtr image;
    /// Image only: the members by encoding, empty until they are needed for a selection.
    std::array<MemberTexts, 2> image_members;
    std::deque<EncodedFrame> encoded;  ///< the oldest first
  };

  ChannelCache& cache_of(monitor::Channel channel);
  void update(monitor::Channel channel, ChannelCache& cache);
  bool has_changed(monitor::Channel channel, ChannelCache& cache);
  bool is_only_later(ChannelCache& cache) const;
  bool is_same_model(ChannelCache& cache) const;
  bool has_new_image(ChannelCache& cache) const;
  MemberTexts members_of(monitor::Channel channel);
  EncodedFrame& encoded_for(ChannelCache& cache, const monitor::Selection& selection) const;
  static std::string content_of(ChannelCache& cache, const monitor::Selection& selection);
  void make(ChannelCache& cache, EncodedFrame& encoded) const;

  Cell& cell_;
  StateEncoder states_;
  /// State, image, display, model; null until the first frame, since most cells are not watched.
  std::array<std::unique_ptr<ChannelCache>, 4> caches_;
};

}  // namespace xr3
