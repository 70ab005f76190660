// The part of an operating system that the server uses, in memory: TCP sockets, epoll, timers and
// the steady clock. The server runs in the only thread. When it waits, `idle` is called,
// in which the clients act, bytes travel and time passes. The seed decides how much arrives when,
// and which calls fail.
#pragma once

#include <sys/epoll.h>
#include <sys/types.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/seeds/random.hpp"

namespace xr3::seeds {

using Ns = std::int64_t;
using Fd = int;
inline constexpr Ns kMillisecond = 1'000'000;
inline constexpr Ns kSecond = 1000 * kMillisecond;
inline constexpr Ns kNoTimer = std::numeric_limits<Ns>::max();
inline constexpr Fd kNoFd = -1;
/// Above all descriptors of the system.
inline constexpr Fd kFirstFd = 1'000'000;

/// Leaves the server's event loop: the run has failed.
class Failure : public std::exception {
 public:
  const char* what() const noexcept override { return "the run has failed"; }
};

/// Probabilities in thousandths for each call.
struct Faults {
  std::size_t again = 0;        ///< recv and send: EAGAIN, although it would work
  std::size_t shorter = 0;      ///< send: fewer bytes than there is room for
  std::size_t interrupted = 0;  ///< recv and epoll_wait: EINTR
  std::size_t accept = 0;       ///< accept: out of descriptors or memory, or aborted
  std::size_t watch = 0;        ///< epoll_ctl: ENOSPC or ENOMEM for new descriptors
  std::size_t socket = 0;       ///< socket: EMFILE
  std::size_t spurious = 0;     ///< epoll_wait: events that have happened before
  std::size_t arrival = 0;      ///< recv and send: bytes arrive meanwhile
  std::size_t worker = 0;       ///< epoll_wait: the worker works meanwhile
  Ns clock_step = 0;            ///< time that passes with each look at the clock
};

/// The bytes on the way to one side of a connection.
struct Stream {
  std::string sent;     ///< on the way
  std::string arrived;  ///< readable
  bool end_is_sent = false;
  bool end_has_arrived = false;
  std::size_t capacity = 64 * 1024;

  std::size_t size() const { return sent.size() + arrived.size(); }
  std::size_t room() const { return capacity - std::min(capacity, size()); }
};

struct Side {
  Fd fd = kNoFd;  ///< of the server; none for a client of the test
  bool is_open = true;
  Stream in;
  int error = 0;          ///< reported once
  bool is_reset = false;  ///< the connection is broken
  bool has_shut = false;  ///< it sends no more
  bool reads_no_more = false;
  bool wants_room = false;   ///< it could not send all
  bool keeps_alive = false;  ///< TCP keepalive
  bool is_silent = false;    ///< vanished: acknowledges nothing
  Ns silent_since = 0;
  Ns max_unacknowledged = 0;  ///< TCP_USER_TIMEOUT; 0: the system's
};

/// Side 0 has connected, side 1 was accepted.
struct Connection {
  Side sides[2];
  std::uint16_t ports[2] = {0, 0};
  bool is_aborted = false;  ///< before it was accepted, by a fault
};
using ConnectionPtr = std::shared_ptr<Connection>;

class Kernel {
 public:
  Kernel(Random& random, const Faults& faults) : random_(random), faults_(faults) {}
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  std::function<void()> idle;          ///< called while the server waits and nothing is ready
  std::size_t max_descriptors = 4096;  ///< RLIMIT_NOFILE
  std::ostream* transcript = nullptr;

  /// The first thing that went wrong; empty: none.
  const std::string& failure() const { return failure_; }
  void fail(const std::string& what);
  /// Sends the process a signal. Its handler writes to a pipe of the system, which the server
  /// watches: the only descriptor that is not of this kernel.
  void raise(int signal);
  /// No more faults from now on.
  void end_faults();
  /// A hash of everything that the server has asked and sent.
  std::uint64_t digest() const { return digest_; }
  /// The server may make this many calls until the next call of idle().
  static constexpr std::size_t kMaxCallsAtOnce = 200'000;
  /// So many events without news, or the server would never be at rest.
  static constexpr std::size_t kMaxSpurious = 50;

  // --- For clients, as side 0.

  /// nullptr if nothing listens there.
  ConnectionPtr connect(std::uint16_t port, std::size_t to_server, std::size_t to_client);
  std::size_t write(Connection& connection, std::string_view bytes);
  std::string read(Connection& connection, std::size_t most);
  void shut(Connection& connection) { shut(connection, 0); }
  void close(Connection& connection) { close(connection, 0); }
  void reset(Connection& connection);
  void vanish(Connection& connection);

  // --- The network and the clock.

  /// Lets some bytes, or all, arrive somewhere. Returns whether there were any.
  bool deliver_some();
  void deliver_all();
  Ns now() const { return now_; }
  Ns next_timer() const;
  void pass(Ns time);
  Ns look_at_clock();

  /// A connection has not been accepted yet.
  bool has_backlog() const;
  std::size_t open_files() const { return files_.size(); }
  std::size_t open_streams() const;
  /// Those of which the server has read the end: it may keep them until it wants to write.
  std::size_t half_closed_streams() const;

  // --- System calls. They return -1 and set errno as the system does.

  bool has(Fd fd) const { return files_.contains(fd); }
  int socket();
  int bind(Fd fd, std::uint16_t port);
  int listen(Fd fd);
  int accept(Fd fd, bool blocks);
  /// The port of the peer, also if the connection is lost.
  int peer_of_accepted(Fd fd);
  int port_of(Fd fd, bool of_peer);
  ssize_t receive(Fd fd, std::span<char> into, bool may_wait);
  ssize_t send(Fd fd, std::span<const std::string_view> parts, bool may_wait);
  int shut(Fd fd, int how);
  int take_error(Fd fd);
  void set_blocking(Fd fd, bool blocks);
  void set_keepalive(Fd fd);
  void set_max_unacknowledged(Fd fd, Ns time);
  int close(Fd fd);
  int new_watch();
  int watch(Fd set, int operation, Fd fd, const epoll_event* event);
  int wait(Fd set, std::span<epoll_event> events, int timeout);
  int poll(Fd fd, int events, int timeout);
  int new_timer();
  void set_timer(Fd fd, Ns when);
  int new_waker();

 private:
  enum class Kind : std::uint8_t { kSocket, kListener, kStream, kWatch, kTimer, kWaker, kForeign };
  struct Item {
    std::uint32_t events;
    epoll_data_t data;
    bool has_news;
  };
  struct File {
    Kind kind;
    bool blocks = true;
    bool keeps_alive = false;  ///< a listener: its connections
    std::uint16_t port = 0;
    ConnectionPtr connection = {};
    int side = 0;
    std::deque<ConnectionPtr> backlog = {};
    std::map<Fd, Item> items = {};
    Ns expiry = kNoTimer;
  };

  Fd open(File file);
  int refuse(int error);
  bool fault(std::size_t thousandths) { return thousandths > 0 && random_.chance(thousandths); }
  void note(std::string_view call, Fd fd, std::int64_t result);
  File* find(Fd fd);
  Side* side_of(Fd fd);
  File* listener_at(std::uint16_t port);
  std::uint16_t free_port() { return next_port_++; }

  std::uint32_t events_of(const File& file) const;
  static std::uint32_t events_of(const Connection& connection, int side);
  std::uint32_t ready_events(Fd fd, const Item& item) const;
  void signal(Fd fd);
  int collect(File& set, std::span<epoll_event> events);

  bool deliver(Connection& connection, int side, std::size_t count);
  bool is_on_the_way(const Connection& connection, int side) const;
  void break_off(Connection& connection, int side, int error);
  void shut(Connection& connection, int side);
  void close(Connection& connection, int side);
  void made_room(Connection& connection, int side);
  void give_up_on_silent();
  void meanwhile();
  void let_worker_run();
  void count_call();

  Random& random_;
  Faults faults_;
  std::string failure_;
  std::uint64_t digest_ = 0;
  std::size_t calls_ = 0;     ///< since the last call of idle()
  std::size_t spurious_ = 0;  ///< events, likewise
  Ns now_ = 1000 * kSecond;
  std::uint16_t next_port_ = 40000;
  std::map<Fd, File> files_;
  std::vector<std::weak_ptr<Connection>> connections_;
};

/// The kernel of the present run; nullptr between runs.
extern Kernel* current_kernel;

}  // namespace xr3::seeds
