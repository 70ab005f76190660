// The sessions of the serial lines of one cell.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "server/lines/arrived.hpp"
#include "server/lines/session.hpp"
#include "server/lines/source.hpp"
#include "server/lines/turns.hpp"
#include "server/net/asio.hpp"
#include "server/net/line_transports.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class LineSessions final : public LineTransports {
 public:
  /// `on_input` is called after each input, and when a line has opened or closed. The references
  /// must outlive the sessions.
  LineSessions(LineTurns& turns, Cell& cell, std::function<void()> on_input);
  LineSessions(const LineSessions&) = delete;
  LineSessions& operator=(const LineSessions&) = delete;
  ~LineSessions() { drop(); }

  /// read_arrived() asks this source for new clients, too. It must outlive its sessions.
  void add(LineSource& source) { sources_.push_back(&source); }

  /// Opens a line and gives it turns. nullopt if the system refuses to watch the
  /// stream; the line is closed then. `place` may be null.
  std::optional<LineId> open(LineSource& source, std::unique_ptr<LineStream> stream,
                             const LineOpened& opened, PeerCounts::Place place = nullptr);

  asio::awaitable<void> read_arrived() override;
  /// Applies the bytes of this source that can be read.
  asio::awaitable<void> read_lines_of(const LineSource& source);
  void run_turns() override { turns_.run_turns(); }
  asio::awaitable<bool> wait_for_bytes(LineId line, std::uint64_t bytes_in,
                                       std::chrono::milliseconds within) override;
  asio::awaitable<void> pause() override { return turns_.pause(); }
  bool disconnect(LineId line) override;
  PortCounters counters() const override;

  /// Gives a line a turn without an event of its stream. No effect if the line is closed.
  void wake(LineId line);

  /// LineTurns::run_events(): finds streams that have ended.
  void run_events() { turns_.run_events(); }

  /// Sessions send their outboxes and end. Those that have not begun to do so at the deadline are
  /// closed at once. The sources must open no further lines.
  void close(WallNs deadline = kNever);
  bool is_empty() const { return sessions_.empty(); }
  /// Closes the remaining sessions at once.
  void abort(LineCloseReason reason = LineCloseReason::kShutdown);
  /// Destroys the remaining sessions without a report, before the objects that they refer to.
  void drop();

 private:
  struct SessionEntry {
    std::shared_ptr<LineSession> session;
    std::optional<SessionNumber> number;  ///< nullopt if it has no turns
  };
  using Sessions = std::map<LineId, SessionEntry>;

  void end(LineId line, LineCloseReason reason);
  void notify(LineId line);
  Sessions sessions() const { return sessions_; }
  void accept_arrived();
  ArrivedBytes arrived(const std::function<bool(const LineSession&)>& matches);
  asio::awaitable<void> read(ArrivedBytes bytes);

  LineTurns& turns_;
  Cell& cell_;
  std::function<void()> on_input_;
  LineSessionContext context_;
  /// By line; cancelled when its bytes were executed, or it has ended.
  std::multimap<LineId, asio::steady_timer*> waiting_;
  std::vector<LineSource*> sources_;
  Sessions sessions_;
  bool is_closing_ = false;
};

}  // namespace xr3
