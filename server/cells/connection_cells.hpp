// The cells of `--cell-per-connection`: a connection of the robot port waits without a cell until
// the guard has passed its first bytes. It then gets a cell, whose line begins with these bytes.
// The cell is closed some time after its line. A client of HTTP or TLS gets none. With a roster, a
// connection from the machine of a student gets a line of the student's cell instead.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "protocol/line/http_tls_detector.hpp"
#include "protocol/line/line_guard.hpp"
#include "server/cells/hosted_cell.hpp"
#include "server/net/asio.hpp"
#include "server/net/listener.hpp"
#include "server/net/peer_counts.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

struct ConnectionCellsRules {
  std::size_t max_lines = 1000;  ///< connections, including those that have not sent a byte
  std::size_t max_cells = 1000;  ///< cells, including those that linger
  WallNs linger = 0;             ///< time for which a cell is kept after its line has closed
  Guard guard = Guard::kNormal;
  PeerCounts peers = PeerCounts();
  /// Called, at most once a second, for a connection that is no robot program; may be empty.
  std::function<void()> report_other = {};
  /// The cell for connections from a machine; nullptr if each gets a new one. May be empty.
  std::function<CellPtr(const asio::ip::address& machine)> cell_of = {};
};

class ConnectionCells {
 public:
  using Open = std::function<CellPtr(const std::string& name)>;
  using Close = std::function<void(const CellPtr& cell)>;

  /// `open` makes a cell and adds it to the registry; `close` removes one.
  ConnectionCells(asio::io_context& io, ConnectionCellsRules rules, Open open, Close close);
  ConnectionCells(const ConnectionCells&) = delete;
  ConnectionCells& operator=(const ConnectionCells&) = delete;

  ~ConnectionCells();

  /// Binds and starts to accept; endpoint() is then valid. Returns the error.
  ErrorCode listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }
  tcp::endpoint endpoint() const { return listener_.endpoint(); }
  /// Accepts no further connection; those that have no cell are closed.
  void close();
  /// Listener::trouble().
  std::string trouble() const { return listener_.trouble(); }
  /// Every line is in use: a further connection is refused.
  bool is_full() const { return waiting_.size() + lines_ >= rules_.max_lines; }

  std::uint64_t accept_failures() const { return listener_.failures(); }
  /// Connections beyond a limit.
  std::uint64_t refused() const { return refused_; }
  /// Connections that were no robot programs, and so got no cell.
  std::uint64_t turned_away() const { return turned_away_; }
  /// The connections that have no cell yet.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Client;
  class CellLine;
  using ClientPtr = std::shared_ptr<Client>;

  void take(NewConnection connection);
  asio::awaitable<void> hand_over(ClientPtr client, CellPtr cell);
  asio::awaitable<void> await_first_bytes(ClientPtr client);
  std::optional<Detection> read(Client& client);
  void serve(Client& client);
  void refuse(const char* why);
  void turn_away();
  void line_ended(const CellLine& line);
  void close_cell(const HostedCell* cell);
  void arm();
  void close_due();

  asio::io_context& io_;
  ConnectionCellsRules rules_;
  Listener listener_;
  Open open_;
  Close close_;
  std::set<ClientPtr> waiting_;
  std::map<const HostedCell*, std::unique_ptr<CellLine>> cells_;
  /// Cells without a line, with the time at which they are closed: the earliest first.
  std::deque<std::pair<WallNs, const HostedCell*>> lingering_;
  asio::steady_timer timer_;
  std::array<char, kFirstChunk> scratch_{};
  std::uint64_t last_ = 0;  ///< the number of the last cell
  std::size_t lines_ = 0;   ///< open lines
  std::uint64_t refused_ = 0;
  std::uint64_t turned_away_ = 0;
  WallNs next_refusal_log_ = 0;
  WallNs next_other_log_ = 0;
  bool is_closing_ = false;
};

}  // namespace xr3
