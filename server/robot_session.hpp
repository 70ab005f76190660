// One TCP connection as the transport of one serial line: bytes from the socket into the cell at the
// tick of their arrival, the line's outbox back to the socket. Ends with its connection.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "server/asio.hpp"
#include "server/cell.hpp"

namespace xr3 {

/// What all sessions of a port share.
struct RobotSessionContext {
  Cell& cell;
  std::span<char> scratch;            ///< what one read may bring
  std::function<void()> acted;        ///< bytes have acted
  std::function<void(LineId)> ended;  ///< the connection is closed; the session may be dropped
};

class RobotSession : public std::enable_shared_from_this<RobotSession> {
 public:
  /// Opens a line of the cell. `context` outlives the session.
  RobotSession(tcp::socket socket, RobotSessionContext& context);

  LineId line() const { return id_; }

  /// Runs until the connection ends.
  void start();

  /// Every byte that has arrived by now acts now.
  void take_in();

  /// No byte is taken any more; the connection ends when its replies have been sent.
  void finish();

  /// Ends the connection now.
  void close(CloseReason reason);

 private:
  asio::awaitable<void> run();
  void take_in(std::size_t most);
  std::size_t read(std::size_t most);
  void act(std::string_view bytes);
  void act_on_pending();
  void flush();

  tcp::socket socket_;
  LineId id_;
  RobotSessionContext& context_;
  std::string pending_;     ///< read, but not taken yet since the outbox was full
  bool has_ended_ = false;  ///< no more bytes will be read
  CloseReason end_ = CloseReason::kClientClosed;  ///< why, once has_ended_
};

}  // namespace xr3
