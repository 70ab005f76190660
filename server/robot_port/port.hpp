// The TCP port of the serial lines: accepts connections up to the limits.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "cell/counters.hpp"
#include "server/lines/sessions.hpp"
#include "server/net/listener.hpp"
#include "server/net/peer_counts.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

struct RobotPortRules {
  std::size_t max_lines;  ///< further connections are closed without a byte
  Guard guard = Guard::kNormal;
  PeerCounts peers = PeerCounts();
  /// With --bind-peer: the first address that sends a byte keeps the port until it had no line for
  /// this time. nullopt if all addresses may use the port.
  std::optional<WallNs> owner_lingers = {};
};

class RobotPort final : public LineSource {
 public:
  /// `cell` and `lines` must outlive the port.
  RobotPort(asio::io_context& io, Cell& cell, LineSessions& lines, RobotPortRules rules);
  /// Binds and starts to accept; endpoint() is then valid. Returns the error.
  ErrorCode listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }
  /// Starts to accept on a socket that listens already, which the port then owns.
  ErrorCode adopt(int listening) { return listener_.adopt(listening); }
  /// Clients connect at this endpoint, which others share; open() gets the connections.
  void share(const tcp::endpoint& endpoint) { shared_ = endpoint; }
  bool is_shared() const { return shared_.has_value(); }
  tcp::endpoint endpoint() const { return shared_ ? *shared_ : listener_.endpoint(); }
  /// Listener::hold() and release().
  void hold(std::function<void()> waiting) { listener_.hold(std::move(waiting)); }
  void release() { listener_.release(); }
  /// Opens a line for a client; refuses it beyond the limits, by closing its connection.
  void open(NewConnection connection);
  /// Accepts no further connection.
  void close();
  /// Listener::trouble(); empty if it shares an endpoint.
  std::string trouble() const { return shared_ ? "" : listener_.trouble(); }
  /// Every line is in use: a further connection is refused.
  bool is_full() const { return open_ >= rules_.max_lines; }

  void accept_arrived() override { listener_.accept_pending(); }
  void line_executed(LineId line) override;
  void line_ended(LineId line, LineCloseReason) override;

  PortCounters counters() const override { return {refused_, listener_.failures(), other_peers_}; }
  /// The address that keeps the port; nullopt if there is none.
  const std::optional<asio::ip::address>& owner() const { return owner_; }
  /// Closes the owner's lines: the port belongs to the next address that speaks. Returns the owner.
  std::optional<asio::ip::address> release_owner();

 private:
  void refuse();
  void refuse_peer(const asio::ip::address& peer);
  void refuse_other(const asio::ip::address& peer);
  bool is_owned_by_other(const asio::ip::address& peer) const { return owner_ && *owner_ != peer; }
  void become_owner(const asio::ip::address& peer);
  void release_later();

  Cell& cell_;
  LineSessions& lines_;
  RobotPortRules rules_;
  Listener listener_;
  std::optional<tcp::endpoint> shared_;
  std::size_t open_ = 0;  ///< lines
  bool has_logged_full_ = false;
  bool has_logged_peer_ = false;
  std::uint64_t refused_ = 0;
  std::optional<asio::ip::address> owner_;
  std::map<LineId, asio::ip::address> peers_of_lines_;  ///< with --bind-peer
  asio::steady_timer release_;                          ///< when the owner loses the port
  std::uint64_t other_peers_ = 0;  ///< connections closed since another address has the port
  WallNs next_other_log_ = 0;
  bool is_closed_ = false;
};

}  // namespace xr3
