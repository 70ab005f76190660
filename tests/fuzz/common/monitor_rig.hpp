// A monitor port in memory: the server's own connections, each over a pair of local sockets, in one
// thread that waits only for the server's worker. The clock is manual and calls need a token, so
// that the answers depend on the client's bytes alone.
#pragma once

#include <string>
#include <string_view>

#include "server/monitor_port/connection.hpp"
#include "server/net/asio.hpp"
#include "server/resources/resources.hpp"
#include "server/service/service.hpp"
#include "server/session/access.hpp"
#include "tests/fuzz/common/pieces.hpp"
#include "tests/support/cell_host.hpp"

namespace xr3::fuzz {

class MonitorRig {
 public:
  /// The rig of all inputs: no input changes it, since none knows the token.
  static MonitorRig& shared();
  /// The same, but reading the cell requires the token, too.
  static MonitorRig& closed();

  /// Serves a client that sends these pieces, then shuts down its sending side. Before each piece
  /// the server does what it can without its worker. Returns everything that the client receives.
  /// Requires that the connection ends, unless the client has a subscription.
  std::string converse(const Pieces& pieces);

  const HttpResources& resources() const { return resources_; }
  /// The answer to a request that HttpResources::refuse() accepts.
  http::Answer answer(const http::HttpRequest& request);

 private:
  class Peer;

  explicit MonitorRig(ReadAccess reading);
  std::string converse_once(const Pieces& pieces);
  bool run_ready();
  void wait_for_worker();
  void exhaust(Peer& peer);
  void settle(Peer& peer);
  void send(Peer& peer, std::string_view bytes);
  void finish(Peer& peer, const MonitorConnection& connection);

  asio::io_context io_{1};
  asio::io_context waiting_{1};  ///< for wait_for_worker(): in io_ only the server's handlers count
  test::CellHost host_{io_};
  AccessPolicy policy_;
  MonitorService service_;
  HttpResources resources_;
  FoxgloveFeeds foxglove_;
  MonitorConnectionContext context_;
  bool is_over_ = false;
};

/// Whether messages of the server tell anything of the cell. A client cannot make it say so: in a
/// string that is repeated to it, the quotes are escaped.
bool shows_the_cell(std::string_view messages);

/// Whether a message makes the server wait: a wrong token is answered 200 ms later. A fuzzer skips
/// such inputs, since they only take time.
bool would_wait(std::string_view message);

}  // namespace xr3::fuzz
