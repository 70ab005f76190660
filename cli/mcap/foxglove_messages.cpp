#include "cli/mcap/foxglove_messages.hpp"

#include "core/coupling.hpp"
#include "protocol/foxglove/line_log.hpp"
#include "protocol/foxglove/messages.hpp"
#include "server/files/base64.hpp"
#include "server/files/data_files.hpp"
#include "server/files/png.hpp"

namespace xr3 {

using foxglove::Nanoseconds;
using foxglove::Topic;

namespace {

constexpr std::size_t kWireChannel = foxglove::kTopics;

}  // namespace

std::vector<mcap::McapChannel> mcap_channels(const Model& model) {
  std::vector<mcap::McapChannel> channels;
  for (const foxglove::TopicInfo& each : foxglove::topics())
    channels.push_back({std::string(each.name), std::string(each.schema),
                        foxglove::schema_text(each.topic, model)});
  channels.push_back({"/wire", "foxglove.Log", foxglove::schema_text(Topic::kEvents, model)});
  return channels;
}

FoxgloveMessages::FoxgloveMessages(std::string file, const Model& model, mcap::McapWriter& writer)
    : file_(std::move(file)), links_(scene_links(model)), writer_(writer) {}

void FoxgloveMessages::add_state(Cell& cell) {
  const Nanoseconds time = time_of(cell.epoch(), cell.state().tick);
  if (!positions_) add(Topic::kScene, time, foxglove::scene_text(links_, time));
  add_transforms(cell, time);
  add_blocks(cell, time);
  add_image(cell, time);
  add(Topic::kState, time, foxglove::state_text(cell.model(), cell.state(), cell.epoch()));
}

void FoxgloveMessages::add_transforms(const Cell& cell, Nanoseconds time) {
  const Positions now = positions(cell.model(), cell.state().motors);
  if (positions_ == now) return;
  positions_ = now;
  add(Topic::kTransforms, time,
      foxglove::transforms_text(links_, cell.model(), cell.state(), time));
}

void FoxgloveMessages::add_blocks(const Cell& cell, Nanoseconds time) {
  auto now = foxglove::placed_blocks(cell.model(), cell.state());
  if (blocks_ == now) return;
  blocks_ = std::move(now);
  add(Topic::kBlocks, time, foxglove::blocks_text(*blocks_, time));
}

void FoxgloveMessages::add_image(Cell& cell, Nanoseconds time) {
  const ImagePtr now = cell.camera_image();
  if (!now || (image_ && *image_ == *now)) return;
  image_ = now;
  add(Topic::kCamera, time, foxglove::image_text(to_base64(to_png(*now)), time));
}

void FoxgloveMessages::add_event(const CellEvent& event, const Model& model) {
  const Nanoseconds time = time_of(event.epoch, event.tick);
  add(Topic::kEvents, time, foxglove::log_text(event, model, time));
}

void FoxgloveMessages::add_wire(const WireRecord& record, const Model& model) {
  const Nanoseconds time = time_of(record.epoch, record.tick);
  add(kWireChannel, time, foxglove::log_text(record, model, time));
}

Nanoseconds FoxgloveMessages::time_of(Epoch epoch, Tick tick) {
  const ReplayTime wanted{epoch, tick};
  if (wanted < latest_) return latest_time_ - foxglove::since_epoch(lateness(wanted));
  constexpr auto kMaxTick = static_cast<Tick>(UINT64_MAX / foxglove::since_epoch(1));
  const Nanoseconds time = timeline_.at(epoch, tick);
  if (tick > kMaxTick || time < latest_time_)
    throw FileError(file_ + ": comes to epoch " + std::to_string(epoch) + ", tick " +
                    std::to_string(tick) + "; all epochs together may have " +
                    std::to_string(kMaxTick) + " ticks, since MCAP counts nanoseconds");
  latest_ = wanted;
  latest_time_ = time;
  return time;
}

/// The ticks by which a moment is before the latest one.
Tick FoxgloveMessages::lateness(const ReplayTime& moment) const {
  return moment.epoch == latest_.epoch ? latest_.tick - moment.tick : 0;
}

void FoxgloveMessages::add(Topic topic, Nanoseconds time, const std::string& message) {
  add(static_cast<std::size_t>(topic), time, message);
}

void FoxgloveMessages::add(std::size_t channel, Nanoseconds time, const std::string& message) {
  writer_.add(channel, time, message);
  ++count_;
}

}  // namespace xr3
