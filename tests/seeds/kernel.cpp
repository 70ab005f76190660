// Connections, the network between their sides, and the clock.
#include "tests/seeds/kernel.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ostream>
#include <utility>

namespace xr3::seeds {
namespace {

// The server's keepalive: 30 s, then three probes 10 s apart.
constexpr Ns kKeepaliveTime = 60 * kSecond;
// The time for which the system repeats bytes that nobody acknowledges.
constexpr Ns kRetransmissionTime = 924 * kSecond;

int other(int side) { return 1 - side; }

}  // namespace

Kernel* current_kernel = nullptr;

void Kernel::fail(const std::string& what) {
  if (failure_.empty()) failure_ = what;
}

void Kernel::raise(int number) {
  std::raise(number);
  for (const auto& [fd, file] : files_) {
    if (file.kind == Kind::kForeign) signal(fd);
  }
}

void Kernel::end_faults() {
  const Ns clock_step = faults_.clock_step;
  faults_ = {};
  faults_.clock_step = clock_step;
}

// --- Files.

// The lowest free number, as in the system: a number that is used too long soon belongs to another.
Fd Kernel::open(File file) {
  Fd fd = kFirstFd;
  for (auto used = files_.lower_bound(fd); used != files_.end() && used->first == fd; ++used) ++fd;
  files_.emplace(fd, std::move(file));
  return fd;
}

Kernel::File* Kernel::find(Fd fd) {
  const auto found = files_.find(fd);
  return found == files_.end() ? nullptr : &found->second;
}

Side* Kernel::side_of(Fd fd) {
  File* file = find(fd);
  if (file == nullptr || file->kind != Kind::kStream) return nullptr;
  return &file->connection->sides[file->side];
}

Kernel::File* Kernel::listener_at(std::uint16_t port) {
  for (auto& [fd, file] : files_) {
    if (file.kind == Kind::kListener && file.port == port) return &file;
  }
  return nullptr;
}

bool Kernel::has_backlog() const {
  return std::any_of(files_.begin(), files_.end(),
                     [](const auto& file) { return !file.second.backlog.empty(); });
}

std::size_t Kernel::open_streams() const {
  return static_cast<std::size_t>(std::count_if(files_.begin(), files_.end(), [](const auto& file) {
    return file.second.kind == Kind::kStream;
  }));
}

std::size_t Kernel::half_closed_streams() const {
  return static_cast<std::size_t>(std::count_if(files_.begin(), files_.end(), [](const auto& each) {
    const File& file = each.second;
    if (file.kind != Kind::kStream) return false;
    const Stream& in = file.connection->sides[file.side].in;
    return in.end_has_arrived && in.arrived.empty();
  }));
}

int Kernel::refuse(int error) {
  if (error != EAGAIN) note("error", kFirstFd, error);
  errno = error;
  return -1;
}

void Kernel::note(std::string_view call, Fd fd, std::int64_t result) {
  for (const char letter : call)
    digest_ = (digest_ ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  digest_ = (digest_ ^ static_cast<std::uint64_t>(fd)) * 0x100000001b3U;
  digest_ = (digest_ ^ static_cast<std::uint64_t>(result)) * 0x100000001b3U;
  if (transcript == nullptr) return;
  *transcript << "  " << now_ / 1000 % 10'000'000'000 << " us  " << call << " " << fd - kFirstFd
              << " = " << result << "\n";
}

// --- Clients.

ConnectionPtr Kernel::connect(std::uint16_t port, std::size_t to_server, std::size_t to_client) {
  File* listener = listener_at(port);
  if (listener == nullptr) return nullptr;
  auto connection = std::make_shared<Connection>();
  connection->ports[0] = free_port();
  connection->ports[1] = port;
  connection->sides[0].in.capacity = to_client;
  connection->sides[1].in.capacity = to_server;
  connection->sides[1].keeps_alive = listener->keeps_alive;
  connections_.push_back(connection);
  listener->backlog.push_back(connection);
  for (auto& [fd, file] : files_) {
    if (&file == listener) signal(fd);
  }
  return connection;
}

std::size_t Kernel::write(Connection& connection, std::string_view bytes) {
  Side& server = connection.sides[1];
  if (connection.sides[0].is_reset || connection.sides[0].has_shut) return 0;
  const std::size_t count = std::min(bytes.size(), server.in.room());
  server.in.sent.append(bytes.substr(0, count));
  return count;
}

std::string Kernel::read(Connection& connection, std::size_t most) {
  Stream& in = connection.sides[0].in;
  std::string bytes = in.arrived.substr(0, most);
  in.arrived.erase(0, bytes.size());
  made_room(connection, 0);
  return bytes;
}

void Kernel::reset(Connection& connection) {
  connection.sides[0].is_open = false;
  break_off(connection, 1, ECONNRESET);
}

void Kernel::vanish(Connection& connection) {
  connection.sides[0].is_silent = true;
  connection.sides[0].silent_since = now_;
}

// --- Connections.

/// The peer of `side` gets a reset, or the system gives up.
void Kernel::break_off(Connection& connection, int side, int error) {
  Side& broken = connection.sides[side];
  if (broken.is_reset) return;
  broken.is_reset = true;
  broken.error = error;
  broken.in.sent.clear();
  connection.sides[other(side)].in.sent.clear();
  signal(broken.fd);
}

void Kernel::shut(Connection& connection, int side) {
  if (std::exchange(connection.sides[side].has_shut, true)) return;
  connection.sides[other(side)].in.end_is_sent = true;
}

// Unread bytes turn the end of the stream into a reset, as in Linux: what is still on its way to
// the peer is lost, and what it has not read may be.
void Kernel::close(Connection& connection, int side) {
  Side& mine = connection.sides[side];
  mine.is_open = false;
  if (mine.in.arrived.empty()) return shut(connection, side);
  if (random_.chance(500)) connection.sides[other(side)].in.arrived.clear();
  break_off(connection, other(side), ECONNRESET);
}

/// `side` has read: the other one may send again.
void Kernel::made_room(Connection& connection, int side) {
  Side& sender = connection.sides[other(side)];
  if (!sender.wants_room || (events_of(connection, other(side)) & EPOLLOUT) == 0) return;
  sender.wants_room = false;
  signal(sender.fd);
}

// --- The network.

bool Kernel::is_on_the_way(const Connection& connection, int side) const {
  const Side& to = connection.sides[side];
  if (to.is_silent || connection.sides[other(side)].is_silent) return false;
  if (to.is_reset) return false;
  return !to.in.sent.empty() || (to.in.end_is_sent && !to.in.end_has_arrived);
}

bool Kernel::deliver(Connection& connection, int side, std::size_t count) {
  if (!is_on_the_way(connection, side)) return false;
  Side& to = connection.sides[side];
  count = std::min(count, to.in.sent.size());
  if (!to.is_open && count > 0) {  // nobody is there any more: the sender gets a reset
    break_off(connection, side, ECONNRESET);
    break_off(connection, other(side), ECONNRESET);
    return true;
  }
  to.in.arrived.append(to.in.sent, 0, count);
  to.in.sent.erase(0, count);
  if (to.in.sent.empty()) to.in.end_has_arrived = to.in.end_is_sent;
  signal(to.fd);
  return true;
}

bool Kernel::deliver_some() {
  std::erase_if(connections_, [](const auto& each) { return each.expired(); });
  std::vector<std::pair<ConnectionPtr, int>> waiting;
  for (const auto& each : connections_) {
    const ConnectionPtr connection = each.lock();
    for (const int side : {0, 1}) {
      if (connection && is_on_the_way(*connection, side)) waiting.emplace_back(connection, side);
    }
  }
  if (waiting.empty()) return false;
  const auto& [connection, side] = waiting[random_.below(waiting.size())];
  const std::size_t size = connection->sides[side].in.sent.size();
  return deliver(*connection, side, random_.chance(300) ? size : random_.spread(size));
}

void Kernel::deliver_all() {
  for (const auto& each : std::vector(connections_)) {
    const ConnectionPtr connection = each.lock();
    for (const int side : {0, 1}) {
      if (connection) deliver(*connection, side, std::string::npos);
    }
  }
}

// Bytes arrive while the server works.
void Kernel::meanwhile() {
  if (fault(faults_.arrival)) deliver_some();
}

// --- The clock.

Ns Kernel::look_at_clock() {
  now_ += faults_.clock_step;
  return now_;
}

Ns Kernel::next_timer() const {
  Ns next = kNoTimer;
  for (const auto& [fd, file] : files_) next = std::min(next, file.expiry);
  return next;
}

void Kernel::pass(Ns time) {
  now_ += time;
  give_up_on_silent();
}

// Keepalive finds a peer that is gone while nothing is unacknowledged; else the bytes time out.
void Kernel::give_up_on_silent() {
  for (const auto& each : connections_) {
    const ConnectionPtr connection = each.lock();
    if (!connection) continue;
    const Side& client = connection->sides[0];
    const Side& server = connection->sides[1];
    const bool is_gone = client.is_silent || (!client.is_open && server.in.end_has_arrived);
    if (!is_gone) continue;
    const Ns unacknowledged =
        server.max_unacknowledged > 0 ? server.max_unacknowledged : kRetransmissionTime;
    const bool has_sent = !client.in.sent.empty();
    const Ns limit = has_sent ? unacknowledged : kKeepaliveTime;
    if ((has_sent || server.keeps_alive) && now_ - client.silent_since >= limit)
      break_off(*connection, 1, ETIMEDOUT);
  }
}

void Kernel::count_call() {
  if (++calls_ < kMaxCallsAtOnce) return;
  fail("the server makes system calls without end");
}

}  // namespace xr3::seeds
