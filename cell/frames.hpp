// What a cell looks like now, for everybody who watches: a frame of each latest-wins channel is made
// once for all who selected the same, and kept until the cell changes. It knows no clients.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/monitor/subscription.hpp"

namespace xr3 {

class FrameCache {
 public:
  /// `cell` outlives it.
  explicit FrameCache(Cell& cell) : cell_(cell) {}

  /// The frame of the selection's channel (state, image, display or model) as the cell is now, valid
  /// until the next call; null for an image where there is no camera. Equal seqs are equal bytes for
  /// equal selections.
  const monitor::Frame* current(const monitor::Selection& selection);

 private:
  /// What one selection made of a frame.
  struct EncodedFrame {
    monitor::Selection selection;
    std::int64_t seq = 0;
    monitor::Frame frame;
  };
  /// What a `model` message is made of, beside the robot.
  struct ShownModel {
    int rev = 0;
    Workcell workcell;
    bool operator==(const ShownModel&) const = default;
  };
  /// One channel's latest frame. `text` and `image` are compared to find out whether it is another.
  struct ChannelCache {
    std::uint64_t revision = 0;  ///< of the cell when it was looked at last
    std::int64_t seq = 0;
    Epoch epoch = 0;
    Tick tick = 0;
    Json members = Json::object();
    std::string text;
    std::optional<Snapshot> snapshot;  ///< state only: what the text shows, at tick 0
    std::optional<ShownModel> model;   ///< model only
    ImagePtr image;
    std::vector<EncodedFrame> encoded;
  };

  const monitor::Frame* look_at(const monitor::Selection& selection);
  void look(monitor::Channel channel, ChannelCache& cache);
  bool has_changed(monitor::Channel channel, ChannelCache& cache) const;
  bool is_only_later(ChannelCache& cache) const;
  bool is_same_model(ChannelCache& cache) const;
  bool has_new_image(ChannelCache& cache) const;
  Json members_now(monitor::Channel channel) const;
  EncodedFrame& encoded_for(ChannelCache& cache, const monitor::Selection& selection) const;
  static std::string content_of(const ChannelCache& cache, const monitor::Selection& selection);
  void make(const ChannelCache& cache, EncodedFrame& encoded) const;

  Cell& cell_;
  std::array<ChannelCache, 4> caches_;  ///< state, image, display, model
};

}  // namespace xr3
