// One TCP connection as the transport of one serial line: bytes from the socket into the cell at the
// tick of their arrival, the line's outbox back to the socket. It is told when something has happened
// at its socket, and ends with its connection.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "server/cell.hpp"
#include "server/robot_socket.hpp"

namespace xr3 {

/// What all sessions of a port share.
struct RobotSessionContext {
  Cell& cell;
  bool is_probe;                      ///< what they open is kProbeLine
  std::span<char> scratch;            ///< what one read may bring
  std::function<void()> acted;        ///< bytes have acted
  std::function<void(LineId)> ended;  ///< the connection is closed; the session may be dropped
};

class RobotSession {
 public:
  /// Opens a line of the cell. `context` outlives the session.
  RobotSession(tcp::socket socket, RobotSessionContext& context);

  LineId line() const { return id_; }
  int descriptor() const { return socket_.descriptor(); }

  /// The client sends no more, or the connection is broken: the next turns read to the end.
  void note_end() { is_ending_ = true; }

  /// Sends what can be sent, and then takes in a fair share. True: there may be more to take in.
  bool take_turn();

  /// Every byte that has arrived by now acts now.
  void take_in();

  /// No byte is taken any more; the connection ends when its replies have been sent.
  void finish();

  /// Ends the connection now.
  void close(CloseReason reason);

 private:
  RobotSession(const std::string& peer, tcp::socket&& socket, RobotSessionContext& context);

  bool take_in(std::size_t most);
  std::size_t read(std::size_t most);
  void act(std::string_view bytes);
  void keep(std::string_view bytes);
  void act_on_pending();
  bool has_flushed();

  RobotSocket socket_;
  LineId id_;
  RobotSessionContext& context_;
  std::string pending_;     ///< read, but not taken yet since the outbox was full
  bool is_ending_ = false;  ///< an end is behind the bytes that are there
  bool has_ended_ = false;  ///< no more bytes will be read
  CloseReason end_ = CloseReason::kClientClosed;  ///< why, once has_ended_
};

}  // namespace xr3
