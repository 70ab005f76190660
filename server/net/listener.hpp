// Accepts TCP connections: as they arrive, or all pending ones on request.
//
// The flow through the folder: a port binds its endpoints with a Listener, which accepts a few
// connections per turn of the event loop and passes each to the port as a descriptor with options
// set. socket_limits.hpp has divided the descriptors of the process among the ports, and
// peer_counts.hpp limits the connections of one address; beyond either limit a connection is
// refused. A connection of the monitor becomes a MonitorSocket (socket.hpp) with time limits; lines
// use their own stream. A coroutine serves it: spawn.hpp starts it so that its exceptions end the
// connection, while those of a loop end the process. memory_limit.hpp sums up what all connections
// hold and closes the greediest beyond --max-memory. Long pure work is done in a worker thread
// (worker.hpp). loop_lag.hpp measures the delay of the event loop, service_manager.hpp reports to
// systemd. standard_input.hpp reads the input of the process, also of other commands.
// line_transports.hpp is the interface by which calls of the monitor reach the lines.
#pragma once

#include <functional>
#include <list>
#include <string>

#include "server/files/descriptor.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

/// Address and port as text: `127.0.0.1:9600`, `[::1]:9600`.
std::string to_text(const tcp::endpoint& endpoint);

/// A new connection: non-blocking, with TCP_NODELAY and TCP keepalive, which detects dead peers
/// within 60 s. The event loop does not watch it yet.
struct NewConnection {
  Descriptor descriptor;
  tcp::endpoint peer;  ///< known even if the connection is lost already
};

/// The address of the client's machine. All addresses of this machine count as one, 127.0.0.1: ::1,
/// and the address under which the client has reached this server if it is also its own.
asio::ip::address machine_of(const NewConnection& connection);

/// The socket of a connection in the event loop. Throws boost::system::system_error if the loop
/// cannot watch it; the connection is then closed.
tcp::socket to_socket(asio::io_context& io, NewConnection connection);

class Listener {
 public:
  using Accepted = std::function<void(NewConnection)>;

  /// `accepted` is called with each new connection. If it throws boost::system::system_error, that
  /// counts as a failure to accept. `name` is a literal, for the log.
  Listener(asio::io_context& io, const char* name, Accepted accepted)
      : io_(io), name_(name), accepted_(std::move(accepted)) {}

  /// Binds and starts to accept, in addition to the endpoints that are already open. Returns the
  /// error; the endpoint is then not open.
  ErrorCode listen(const tcp::endpoint& endpoint);
  /// Adopts a socket that listens already, and accepts on it. Returns the error. (Clients that have
  /// connected before are without keepalive.)
  ErrorCode adopt(int listening);
  /// The first endpoint that was opened.
  tcp::endpoint endpoint() const { return endpoint_; }

  /// The number of failed attempts to accept a connection, such as without descriptors.
  std::uint64_t failures() const { return failures_; }
  /// Empty if connections are accepted. Otherwise, as a sentence: it is closed, or why the last
  /// attempt to accept one has failed.
  std::string trouble() const;

  /// Leaves connections pending in the kernel until release(); calls `waiting` when one is.
  void hold(std::function<void()> waiting);
  void release();

  /// Accepts every connection that is pending in the kernel, unless they are held.
  void accept_pending();
  void close();

 private:
  struct BoundAcceptor {
    tcp::acceptor acceptor;
    asio::steady_timer retry;  ///< after a failure to accept, or while connections are held
  };

  ErrorCode begin(tcp::acceptor acceptor);
  asio::awaitable<void> run(BoundAcceptor& bound);
  /// Accepts a few connections. False if one is pending that cannot be accepted now.
  bool accept_some(tcp::acceptor& acceptor);
  ErrorCode accept_one(tcp::acceptor& acceptor);
  ErrorCode hand_over(NewConnection connection);
  void report_failure(ErrorCode error);

  asio::io_context& io_;
  const char* name_;
  std::list<BoundAcceptor> acceptors_;
  Accepted accepted_;
  tcp::endpoint endpoint_;
  std::function<void()> held_;  ///< empty unless connections are held
  std::uint64_t failures_ = 0;
  ErrorCode failure_;  ///< error of the last attempt; no error if it has succeeded
};

}  // namespace xr3
