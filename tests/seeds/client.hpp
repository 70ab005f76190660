// The clients of a run. A client sends its bytes in pieces, reads in pieces and ends, as the seed
// decides, and then checks what it received.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tests/seeds/kernel.hpp"
#include "tests/seeds/reference.hpp"

namespace xr3::seeds {

/// The end of a client that has sent everything.
enum class Ending : std::uint8_t { kWaits, kShutsDown, kCloses, kResets, kVanishes };

/// State that all clients of a run share.
struct World {
  Random& random;
  Kernel& kernel;
  SharedModel model;
  std::uint16_t robot_port = 9600;
  std::uint16_t monitor_port = 9601;
  bool is_manual = true;     ///< the clock, until the end of the run
  bool is_lockstep = false;  ///< one client moves the robot and the time; the others only look
  bool is_crowded = false;   ///< connections may be refused because there are too many
  bool is_harmed = false;    ///< memory or descriptors were missing: connections may end early
  bool is_stopping = false;  ///< the server has received SIGTERM
  bool has_jumped = false;   ///< time has jumped: the server may have lost patience with a client
};

class Client {
 public:
  Client(World& world, std::uint16_t port);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  virtual ~Client() = default;

  /// Does something: connects, sends, reads or ends.
  virtual void act();
  /// Reads and sends everything, unless it misbehaves. Returns whether anything was possible.
  virtual bool settle();
  /// Has nothing more to send, and expects nothing.
  virtual bool is_done() const { return is_over() || (pending().empty() && !expects_more()); }
  virtual void leave();
  /// Calls fail() of the kernel if something that it received is wrong, or, if `is_complete`,
  /// missing.
  virtual void verify(bool is_complete) = 0;
  virtual std::string name() const = 0;

 protected:
  /// Called with new bytes.
  virtual void received(std::string_view bytes) { in_.append(bytes); }
  virtual bool expects_more() const { return false; }

  void queue(std::string_view bytes) { out_.append(bytes); }
  std::string_view pending() const { return std::string_view(out_).substr(sent_); }
  /// The bytes that it has sent; the server may not have read them yet.
  std::string_view sent() const { return std::string_view(out_).substr(0, sent_); }
  /// Its port, for messages.
  std::string place() const;
  bool is_connected() const { return connection_ != nullptr; }
  /// The connection is over on this side, or broken.
  bool is_over() const;
  /// The server has ended the connection and everything was read.
  bool is_ended_by_server() const;
  /// It reads everything and stays until the end, and its connection was not hurt by a fault.
  bool is_tame() const;
  void fail(const std::string& what);
  void end(Ending ending);

  World& world_;
  std::uint16_t port_;
  ConnectionPtr connection_;
  std::string in_;
  Ending ending_ = Ending::kWaits;
  bool never_reads_ = false;
  bool is_slow_ = false;  ///< reads only when it settles
  std::size_t most_at_once_ = 4096;

 private:
  bool connect();
  void send_some(std::size_t most);
  bool read_some(std::size_t most);

  std::string out_;
  std::size_t sent_ = 0;
  bool has_left_ = false;
};

using ClientPtr = std::unique_ptr<Client>;

/// A robot program. `letter` is the joint that only this line moves, 0 for none.
ClientPtr make_robot(World& world, char letter);
/// A robot program and a monitor that advance the manual clock together.
ClientPtr make_lockstep(World& world);
/// A monitor client over JSON lines, and over WebSocket. `number` makes its ids unique.
ClientPtr make_monitor(World& world, int number);
ClientPtr make_websocket(World& world, int number);
/// A web browser or a script.
ClientPtr make_browser(World& world);
/// Bytes that belong to no protocol, or to another one, on either port.
ClientPtr make_stranger(World& world);
/// Checks at the end of a run that nobody else is connected.
ClientPtr make_inspector(World& world);

}  // namespace xr3::seeds
