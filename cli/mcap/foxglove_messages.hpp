// The messages of a file that Foxglove and Lichtblick open: on the topics of the live endpoint, and
// on `/wire` what was said on the serial lines. Each message is added only if it differs from the
// last one of its topic in more than its time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/foxglove/scene.hpp"
#include "protocol/foxglove/time.hpp"
#include "protocol/foxglove/topics.hpp"
#include "protocol/mcap/writer.hpp"

namespace xr3 {

/// The channels of a file about a robot.
std::vector<mcap::McapChannel> mcap_channels(const Model& model);

class FoxgloveMessages {
 public:
  /// `file` is the recording, for errors. The writer has the channels of the model, and outlives
  /// the messages.
  FoxgloveMessages(std::string file, const Model& model, mcap::McapWriter& writer);

  // Epochs must not decrease. Each call throws FileError if a time is beyond what MCAP has.

  /// Time has passed without a message: the next epoch begins after it.
  void pass_to(const Cell& cell) { time_of(cell.epoch(), cell.state().tick); }
  /// Adds what has changed since the last call.
  void add_state(Cell& cell);
  void add_event(const CellEvent& event, const Model& model);
  void add_wire(const WireRecord& record, const Model& model);

  std::uint64_t count() const { return count_; }
  /// The latest time, since tick 0 of the first epoch.
  foxglove::Nanoseconds latest_time() const { return latest_time_; }

 private:
  /// With a byte clock, bytes may be reported after a later moment.
  foxglove::Nanoseconds time_of(Epoch epoch, Tick tick);
  Tick lateness(const ReplayTime& moment) const;
  void add(std::size_t channel, foxglove::Nanoseconds time, const std::string& message);
  void add(foxglove::Topic topic, foxglove::Nanoseconds time, const std::string& message);
  void add_transforms(const Cell& cell, foxglove::Nanoseconds time);
  void add_blocks(const Cell& cell, foxglove::Nanoseconds time);
  void add_image(Cell& cell, foxglove::Nanoseconds time);

  std::string file_;
  std::vector<SceneLink> links_;
  mcap::McapWriter& writer_;
  foxglove::Timeline timeline_;
  ReplayTime latest_;
  foxglove::Nanoseconds latest_time_ = 0;
  std::optional<Positions> positions_;                        ///< in the last transforms
  std::optional<std::vector<foxglove::PlacedBlock>> blocks_;  ///< in the last `/blocks`
  ImagePtr image_;                                            ///< in the last `/camera`
  std::uint64_t count_ = 0;
};

}  // namespace xr3
