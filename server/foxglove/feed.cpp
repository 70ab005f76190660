#include "server/foxglove/feed.hpp"

#include <algorithm>
#include <utility>

#include "protocol/foxglove/messages.hpp"
#include "server/files/base64.hpp"
#include "server/foxglove/session.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

using foxglove::Topic;

std::size_t place_of(Topic topic) { return static_cast<std::size_t>(topic); }

/// All frames of the state, with as few members as possible: only their rhythm is of use.
monitor::Subscribe every_state() {
  monitor::Subscribe wanted;
  wanted.selection = {monitor::Channel::kState, {{"moving"}}, {}};
  wanted.max_millihz = monitor::kFramesPerSecond * 1000;
  wanted.on_change = false;
  return wanted;
}

}  // namespace

FoxgloveFeed::FoxgloveFeed(const asio::any_io_executor& executor, CellPtr at)
    : MonitorSession(static_cast<MessageSink&>(*this), Access::kRead, at->name()),
      executor_(executor),
      at_(std::move(at)),
      links_(scene_links(at_->cell().model())) {
  at_->cell().catch_up(wall_now());
  take_snapshot();
  client().follow_frames(at_->name(), every_state());
  at_->hub().add(*this);
  at_->hub().changed();
}

// NOLINTNEXTLINE(bugprone-exception-escape): remove() throws only without memory for its caller
FoxgloveFeed::~FoxgloveFeed() { at_->hub().remove(*this); }

// --- Snapshots.

/// Called by the hub when it has served this feed, and when the cell closes.
void FoxgloveFeed::pump() {
  const auto self = shared_from_this();  // the last session may end meanwhile
  bool is_served = false;
  while (next_output()) is_served = true;
  if (!client().follows(at_->name())) {
    for (FoxgloveSession* session : sessions_) session->end(monitor::CloseReason::kShutdown);
  } else if (is_served) {
    take_snapshot();
    offer_changes();
  }
}

void FoxgloveFeed::take_snapshot() {
  Cell& cell = at_->cell();
  Snapshot now = cell.snapshot();
  const bool is_first = !model_;
  const bool is_new_epoch = is_first || now.epoch != snapshot_.epoch;
  if (!is_first && now == snapshot_ && events_end_ == cell.events().next()) return;
  model_ = cell.model_ptr();
  snapshot_ = std::move(now);
  events_end_ = cell.events().next();
  renew(Topic::kTransforms);
  renew(Topic::kState);
  if (is_new_epoch) renew(Topic::kScene);
  auto blocks = foxglove::placed_blocks(*model_, snapshot_.state);
  if (is_new_epoch || blocks != blocks_) renew(Topic::kBlocks);
  blocks_ = std::move(blocks);
  if (is_new_epoch) picture_.reset();
  take_picture();
}

void FoxgloveFeed::renew(Topic topic) {
  texts_.at(place_of(topic)).reset();
  changed_.set(place_of(topic));
}

void FoxgloveFeed::offer_changes() {
  const TopicSet changed = std::exchange(changed_, {});
  if (changed.none()) return;
  for (FoxgloveSession* session : sessions_) session->offer(changed);
}

// --- Messages.

monitor::Message FoxgloveFeed::text(Topic topic) {
  monitor::Message& text = texts_.at(place_of(topic));
  if (!text && topic != Topic::kCamera) text = std::make_shared<const std::string>(make(topic));
  return text;
}

std::string FoxgloveFeed::make(Topic topic) const {
  const State& state = snapshot_.state;
  switch (topic) {
    case Topic::kTransforms: return foxglove::transforms_text(links_, *model_, state, time());
    case Topic::kScene: return foxglove::scene_text(links_, time());
    case Topic::kBlocks: return foxglove::blocks_text(blocks_, time());
    case Topic::kState: return foxglove::state_text(*model_, state, snapshot_.epoch);
    case Topic::kCamera:
    case Topic::kEvents: break;  // made elsewhere
  }
  return {};
}

std::optional<FoxgloveFeed::NumberedEvent> FoxgloveFeed::event(std::int64_t seq) const {
  std::vector<CellEvent> found;
  const std::int64_t end = at_->cell().copy_events(seq, 1, found);
  if (found.empty()) return std::nullopt;
  const foxglove::Nanoseconds time = foxglove::since_epoch(found.front().tick);
  return NumberedEvent{end - 1, foxglove::log_text(found.front(), *model_, time)};
}

// --- The camera.

bool FoxgloveFeed::follow_camera() {
  take_picture();
  return model_->workcell().camera.has_value();
}

/// Makes a message of the picture now, if a session follows it and it has changed.
void FoxgloveFeed::take_picture() {
  const bool is_followed = std::ranges::any_of(
      sessions_, [](const FoxgloveSession* each) { return each->follows(Topic::kCamera); });
  if (!is_followed || is_compressing_) return;
  ImagePtr image = at_->cell().camera_image();
  const bool is_known = picture_ && image && *picture_ == *image;
  if (!image || is_known) return;
  is_compressing_ = true;
  spawn_session(executor_, "foxglove", compress(std::move(image)), [self = shared_from_this()] {
    self->is_compressing_ = false;
    self->take_picture();  // the image may have changed meanwhile
  });
}

asio::awaitable<void> FoxgloveFeed::compress(ImagePtr image) {
  const http::Body png = co_await at_->pictures().png(image);
  picture_ = std::move(image);
  texts_.at(place_of(Topic::kCamera)) =
      std::make_shared<const std::string>(foxglove::image_text(to_base64(png.bytes()), time()));
  changed_.set(place_of(Topic::kCamera));
  offer_changes();
}

}  // namespace xr3
