// One TCP connection as the transport of one serial line: bytes from the socket into the cell at the
// tick of their arrival, the line's outbox back to the socket. It is told when something has happened
// at its socket, and ends with its connection.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "cell/cell.hpp"
#include "server/robot_port/socket.hpp"

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

  /// Sends what can be sent, and then takes in a fair share of bytes for a fair time. True: there may
  /// be more to do at once.
  bool run_turn();

  /// Every byte that has arrived by now acts now, unless replies wait for the client or are more than
  /// kMaxAnswered in all. True: there may be more to do at once.
  bool read_arrived();
  static constexpr std::size_t kMaxAnswered = 1024 * 1024;

  /// No byte is taken any more; the connection ends when its replies have been sent.
  void finish();

  /// Ends the connection now.
  void close(LineCloseReason reason);

 private:
  RobotSession(const std::string& peer, tcp::socket&& socket, RobotSessionContext& context);

  /// The bounds of what is done before others have their turns.
  struct Turn {
    std::size_t most_read;
    std::uint64_t output_end;  ///< of the line, in all
    WallNs end;
  };
  enum class Left : std::uint8_t { kNothing, kSome, kWaits };  ///< kWaits: until news come

  Left work(Turn turn);
  Left flush(const Turn& turn);
  bool is_over(const Turn& turn) const;
  std::size_t read(std::size_t most);
  void act(std::string_view bytes, const Turn& turn);
  void keep(std::string_view bytes);
  void act_on_pending(const Turn& turn);

  RobotSocket socket_;
  LineId id_;
  RobotSessionContext& context_;
  std::string pending_;     ///< read, but not taken yet since the outbox was full
  bool is_ending_ = false;  ///< an end is behind the bytes that are there
  bool has_ended_ = false;  ///< no more bytes will be read
  LineCloseReason end_ = LineCloseReason::kClientClosed;  ///< why, once has_ended_
};

}  // namespace xr3
