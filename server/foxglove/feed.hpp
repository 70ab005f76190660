// The messages of one cell for its Foxglove clients: each is made once, when the first client sends
// it, from the snapshot that the last round of the cell's subscribers has shown.
//
// The flow through the folder: a WebSocket of the path /foxglove has a FoxgloveSession
// (session.hpp), which carries out subscriptions (protocol/foxglove/wire.hpp) and sends the
// messages that are due. All sessions of a cell share a FoxgloveFeed, which FoxgloveFeeds
// (feeds.hpp) finds. The feed follows the channel `state` like a client of the monitor, so that the
// cell's SubscriberHub serves it in turn with them, at most 60 times a second. It then takes a
// snapshot, and marks the topics that have changed as due in its sessions. A session that has not
// yet sent a topic sends only its latest message. Events are read from the ring of the cell. The
// worker compresses pictures.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/foxglove/scene.hpp"
#include "protocol/foxglove/topics.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "server/cells/hosted_cell.hpp"
#include "server/net/asio.hpp"
#include "server/session/message_sink.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class FoxgloveSession;

/// By Topic.
using TopicSet = std::bitset<foxglove::kTopics>;

class FoxgloveFeed final : public std::enable_shared_from_this<FoxgloveFeed>,
                           private MonitorSession,
                           private MessageSink {
 public:
  FoxgloveFeed(const asio::any_io_executor& executor, CellPtr at);
  ~FoxgloveFeed();  // NOLINT(bugprone-exception-escape): as in the definition

  const CellPtr& cell() const { return at_; }
  const Model& model() const { return *model_; }

  /// Notifies the session of changes until remove(), which its destructor calls.
  void add(FoxgloveSession& session) { sessions_.push_back(&session); }
  void remove(FoxgloveSession& session) { std::erase(sessions_, &session); }

  /// Makes the picture of the camera, to be offered later. To be called when a session begins to
  /// follow it. Returns false if there is no camera.
  bool follow_camera();

  // --- As of the last snapshot.

  foxglove::Nanoseconds time() const { return foxglove::since_epoch(snapshot_.state.tick); }
  /// The latest message; nullptr if there is no picture.
  monitor::Message text(foxglove::Topic topic);
  /// The seq after that of the last event.
  std::int64_t events_end() const { return events_end_; }
  /// The event with this seq, or the first one after it that is kept; nullopt if there is none.
  struct NumberedEvent {
    std::int64_t seq;
    std::string text;
  };
  std::optional<NumberedEvent> event(std::int64_t seq) const;

 private:
  void pump() override;
  void take_snapshot();
  void renew(foxglove::Topic topic);
  std::string make(foxglove::Topic topic) const;
  void offer_changes();
  void take_picture();
  asio::awaitable<void> compress(ImagePtr image);

  asio::any_io_executor executor_;
  CellPtr at_;
  std::vector<SceneLink> links_;
  ModelPtr model_;
  Snapshot snapshot_;
  std::vector<foxglove::PlacedBlock> blocks_;
  std::int64_t events_end_;
  std::array<monitor::Message, foxglove::kTopics> texts_;  ///< null if not made yet
  TopicSet changed_;
  ImagePtr picture_;  ///< the last one that was compressed
  bool is_compressing_ = false;
  std::vector<FoxgloveSession*> sessions_;
};

}  // namespace xr3
