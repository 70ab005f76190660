#include "server/cells/connection_cells.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/buffer.hpp>
#include <utility>

#include "server/net/spawn.hpp"
#include "server/robot_port/socket.hpp"

namespace xr3 {
namespace {

constexpr const char* kConnectionsName = "the robot port";
constexpr WallNs kLogEvery = 1'000'000'000;

/// Whether a message may be logged, of a kind that clients cause: at most one a second.
bool is_due(WallNs& next) {
  const WallNs now = wall_now();
  if (now < next) return false;
  next = now + kLogEvery;
  return true;
}

}  // namespace

/// A connection without a cell.
struct ConnectionCells::Client {
  tcp::socket socket;
  tcp::endpoint peer;
  PeerCounts::Place place;
  HttpTlsDetector detector;
  std::string bytes;  ///< read so far
};

/// The one line of a cell.
class ConnectionCells::CellLine final : public LineSource {
 public:
  CellLine(ConnectionCells& owner, CellPtr cell) : owner_(owner), cell_(std::move(cell)) {}
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
  const asio::ip::address machine = machine_of(connection);
  const CellPtr known = rules_.cell_of ? rules_.cell_of(machine) : nullptr;
  if (!known && is_full()) return refuse("as many lines are open as --max-lines allows");
  auto place = rules_.peers.take(machine);
  if (!place)
    return refuse("the client has as many lines open as one address may have (--max-per-address)");
  const tcp::endpoint peer = connection.peer;
  const auto client = std::make_shared<Client>(
      Client{to_socket(io_, std::move(connection)), peer, std::move(place), {}, {}});
  waiting_.insert(client);
  spawn_loop(io_.get_executor(), kConnectionsName,
             known ? hand_over(client, known) : await_first_bytes(client));
}

/// Gives the connection to the port of a cell, which may have to come back first.
asio::awaitable<void> ConnectionCells::hand_over(ClientPtr client, CellPtr cell) {
  co_await cell->be_back();
  waiting_.erase(client);
  if (is_closing_) co_return;
  client->place.reset();
  ErrorCode ignored;
  cell->port()->open({Descriptor(client->socket.release(ignored)), client->peer});
}

asio::awaitable<void> ConnectionCells::await_first_bytes(ClientPtr client) {
  std::optional<Detection> found = Detection::kUndecided;
  while (found == Detection::kUndecided) {
    const auto [error] = co_await client->socket.async_wait(tcp::socket::wait_read, kAwait);
    found = error ? std::nullopt : read(*client);
  }
  waiting_.erase(client);
  if (found == Detection::kNotARobotProgram) turn_away();
  if (found == Detection::kPass && !is_closing_) serve(*client);
}

/// Reads and examines the bytes that have arrived. nullopt if the connection has ended.
std::optional<Detection> ConnectionCells::read(Client& client) {
  ErrorCode error;
  const std::size_t count = client.socket.read_some(asio::buffer(scratch_), error);
  if (error == asio::error::would_block || error == asio::error::interrupted)
    return Detection::kUndecided;
  if (error) return std::nullopt;
  const std::string_view bytes(scratch_.data(), count);
  const bool is_first = client.bytes.empty();
  client.bytes += bytes;
  if (rules_.guard == Guard::kOff) return Detection::kPass;
  if (is_first && is_refused(bytes, rules_.guard)) return Detection::kNotARobotProgram;
  Detection found = Detection::kUndecided;
  for (std::size_t i = 0; i < count && found == Detection::kUndecided; ++i)
    found = client.detector.feed(static_cast<std::uint8_t>(bytes[i]));
  return found;
}

// --- Cells.

void ConnectionCells::serve(Client& client) {
  if (cells_.size() >= rules_.max_cells && !lingering_.empty())
    close_cell(lingering_.front().second);
  if (cells_.size() >= rules_.max_cells)
    return refuse("as many cells have a line as --max-cells allows");
  const CellPtr cell = open_("c" + std::to_string(++last_));
  const auto served = cells_.emplace(cell.get(), std::make_unique<CellLine>(*this, cell)).first;
  const LineOpened opened{to_text(client.peer), LineKind::kTcp, rules_.guard};
  ++lines_;
  ErrorCode ignored;
  cell->lines().open(*served->second,
                     std::make_unique<RobotSocket>(Descriptor(client.socket.release(ignored)),
                                                   std::move(client.bytes)),
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

void ConnectionCells::line_ended(const CellLine& line) {
  --lines_;
  if (is_closing_) return;
  lingering_.emplace_back(wall_now() + rules_.linger, line.cell().get());
  if (lingering_.size() == 1) arm();
}

void ConnectionCells::close_cell(const HostedCell* cell) {
  std::erase_if(lingering_, [cell](const auto& each) { return each.second == cell; });
  close_(cells_.extract(cell).mapped()->cell());
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
