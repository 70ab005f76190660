#include "server/cells/connection_cells.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "server/net/spawn.hpp"
#include "server/robot_port/socket.hpp"

namespace xr3 {
namespace {

constexpr const char* kConnectionsName = "the robot port";
constexpr WallNs kLogEvery = 1'000'000'000;

/// The socket is reported as readable when it has so many bytes, or has ended.
void set_low_water(tcp::socket& socket, std::size_t bytes) {
  const int count = static_cast<int>(bytes);
  ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVLOWAT, &count, sizeof count);
}

/// Whether a message may be logged, of a kind that clients cause: at most one a second.
bool is_due(WallNs& next) {
  const WallNs now = wall_now();
  if (now < next) return false;
  next = now + kLogEvery;
  return true;
}

}  // namespace

/// A connection without a cell. Its bytes stay in the kernel until it has one.
struct ConnectionCells::Client {
  tcp::socket socket;
  tcp::endpoint peer;
  PeerCounts::Place place;
  HttpTlsDetector detector;
  std::size_t seen = 0;  ///< bytes that the detector has examined
};

/// The one line of a cell.
class ConnectionCells::Guest final : public LineSource {
 public:
  Guest(ConnectionCells& owner, CellPtr cell) : owner_(owner), cell_(std::move(cell)) {}
  const CellPtr& cell() const { return cell_; }

  void accept_arrived() override {}
  void line_ended(LineId, LineCloseReason) override { owner_.line_ended(*this); }

 private:
  ConnectionCells& owner_;
  CellPtr cell_;
};

ConnectionCells::ConnectionCells(asio::io_context& io, ConnectionCellsRules rules, Open open,
                                 Close close)
    : io_(io),
      rules_(std::move(rules)),
      listener_(io, kConnectionsName,
                [this](NewConnection connection) { take(std::move(connection)); }),
      open_(std::move(open)),
      close_(std::move(close)),
      timer_(io) {}

ConnectionCells::~ConnectionCells() = default;

// --- Connections without a cell.

void ConnectionCells::take(NewConnection connection) {
  if (is_full()) return refuse("as many lines are open as --max-lines allows");
  auto place = rules_.peers.take(machine_of(connection));
  if (!place)
    return refuse("the client has as many lines open as one address may have (--max-per-address)");
  const tcp::endpoint peer = connection.peer;
  const auto client = std::make_shared<Client>(
      Client{to_socket(io_, std::move(connection)), peer, std::move(place), {}, 0});
  waiting_.insert(client);
  spawn_loop(io_.get_executor(), kConnectionsName, await_first_byte(client));
}

asio::awaitable<void> ConnectionCells::await_first_byte(ClientPtr client) {
  First first = First::kNothing;
  while (first == First::kNothing) {
    const auto [error] = co_await client->socket.async_wait(tcp::socket::wait_read, kAwait);
    first = error || is_closing_ ? First::kEnd : look(*client);
  }
  waiting_.erase(client);
  if (first == First::kOther) turn_away();
  if (first == First::kRobot && !is_closing_) serve(*client);
}

/// Examines the bytes that have arrived, and leaves them where they are.
ConnectionCells::First ConnectionCells::look(Client& client) {
  const auto count = ::recv(client.socket.native_handle(), scratch_.data(), scratch_.size(),
                            MSG_PEEK | MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
    return First::kNothing;
  const auto bytes = static_cast<std::size_t>(std::max<decltype(count)>(count, 0));
  if (bytes <= client.seen) return First::kEnd;  // it has ended
  const First first = judge(client, {scratch_.data(), bytes});
  set_low_water(client.socket, first == First::kNothing ? bytes + 1 : 1);
  return first;
}

ConnectionCells::First ConnectionCells::judge(Client& client, std::string_view bytes) const {
  if (rules_.guard == Guard::kOff) return First::kRobot;
  if (client.seen == 0 && is_refused(bytes, rules_.guard)) return First::kOther;
  while (client.seen < bytes.size()) {
    const Detection found = client.detector.feed(static_cast<std::uint8_t>(bytes[client.seen++]));
    if (found == Detection::kPass) return First::kRobot;
    if (found == Detection::kNotARobotProgram) return First::kOther;
  }
  return First::kNothing;
}

// --- Cells.

void ConnectionCells::serve(Client& client) {
  if (guests_.size() >= rules_.max_cells && !lingering_.empty())
    close_cell(lingering_.front().second);
  if (guests_.size() >= rules_.max_cells)
    return refuse("as many cells have a line as --max-cells allows");
  const CellPtr cell = open_("c" + std::to_string(++last_));
  const auto guest = guests_.emplace(cell.get(), std::make_unique<Guest>(*this, cell)).first;
  const LineOpened opened{to_text(client.peer), LineKind::kTcp, rules_.guard};
  ++lines_;
  ErrorCode ignored;
  cell->lines().open(*guest->second,
                     std::make_unique<RobotSocket>(Descriptor(client.socket.release(ignored))),
                     opened, std::move(client.place));
}

void ConnectionCells::refuse(const char* why) {
  ++refused_;
  if (is_due(next_refusal_log_))
    spdlog::warn("a connection of the robot port is refused: {}; {} since the start", why,
                 refused_);
}

void ConnectionCells::turn_away() {
  ++turned_away_;
  if (rules_.report_other && is_due(next_other_log_)) rules_.report_other();
}

void ConnectionCells::line_ended(Guest& guest) {
  --lines_;
  if (is_closing_) return;
  lingering_.emplace_back(wall_now() + rules_.linger, guest.cell().get());
  if (lingering_.size() == 1) arm();
}

void ConnectionCells::close_cell(const HostedCell* cell) {
  std::erase_if(lingering_, [cell](const auto& each) { return each.second == cell; });
  const auto guest = guests_.extract(cell);
  close_(guest.mapped()->cell());
}

// One timer for all: every cell lingers for the same time, so the first of the queue goes first.
void ConnectionCells::arm() {
  if (lingering_.empty() || is_closing_) return;
  run_at(timer_, lingering_.front().first, [this] { close_due(); });
}

void ConnectionCells::close_due() {
  const WallNs now = wall_now();
  while (!lingering_.empty() && lingering_.front().first <= now)
    close_cell(lingering_.front().second);
  arm();
}

void ConnectionCells::close() {
  is_closing_ = true;
  listener_.close();
  timer_.cancel();
  ErrorCode ignored;
  for (const ClientPtr& client : waiting_) client->socket.close(ignored);
}

}  // namespace xr3
