// Caches the current frame of each latest-wins channel. A frame is encoded once for all clients
// with the same selection, and kept until the cell changes. Independent of clients. It
// encodes copies of a cell's data, so that another thread can do it for a large cell.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "protocol/monitor/subscription.hpp"

namespace xr3 {

/// A copy of the data of a cell from which the frames of one channel are made.
struct FrameSource {
  monitor::Channel channel{};
  std::uint64_t revision = 0;  ///< of the cell
  ModelPtr model;
  Snapshot snapshot;
  ImagePtr image;  ///< of the channel image only; nullptr without a camera
};
/// The data now. An image is rendered if it has changed.
FrameSource frame_source(Cell& cell, monitor::Channel channel);

class FrameCache {
 public:
  /// `cell` is the cell's name in the frames.
  explicit FrameCache(std::string cell) : cell_(std::move(cell)) {}

  /// Whether the channel (state, image, display or model) shows this revision of the cell.
  bool is_current(monitor::Channel channel, std::uint64_t revision) const;
  /// Makes the channel show a newer revision of the cell.
  void show(const FrameSource& source);

  /// The frame of the selection's channel, valid until the next call; nullptr for an image if there
  /// is no camera. Frames with equal seq and selection have equal bytes. Precondition: show() was
  /// called for the channel.
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
  void update(const FrameSource& source, ChannelCache& cache);
  bool has_changed(const FrameSource& source, ChannelCache& cache);
  static bool is_only_later(const FrameSource& source, ChannelCache& cache);
  static bool is_same_model(const FrameSource& source, ChannelCache& cache);
  static bool has_new_image(const FrameSource& source, ChannelCache& cache);
  MemberTexts members_of(const FrameSource& source);
  EncodedFrame& encoded_for(ChannelCache& cache, const monitor::Selection& selection) const;
  static std::string content_of(ChannelCache& cache, const monitor::Selection& selection);
  void make(ChannelCache& cache, EncodedFrame& encoded) const;

  std::string cell_;
  StateEncoder states_;
  std::array<ChannelCache, 4> caches_;  ///< state, image, display, model
};

}  // namespace xr3
