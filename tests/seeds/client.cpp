#include "tests/seeds/client.hpp"

#include <algorithm>
#include <utility>

namespace xr3::seeds {
namespace {

// Bytes on their way at once, at the end of a run: it should not take long.
constexpr std::size_t kQuickly = 64 * 1024;

}  // namespace

Client::Client(World& world, std::uint16_t port) : world_(world), port_(port) {
  Random& random = world.random;
  most_at_once_ = random.chance(300) ? random.between(1, 8) : random.between(16, 16'384);
  if (random.chance(150)) is_slow_ = true;
  if (random.chance(50)) never_reads_ = true;
  if (random.chance(600)) return;
  ending_ = random.any_of({Ending::kShutsDown, Ending::kShutsDown, Ending::kCloses, Ending::kResets,
                           Ending::kVanishes});
}

bool Client::connect() {
  Random& random = world_.random;
  const auto capacity = [&random] {
    return random.chance(500) ? std::size_t{65'536} : random.spread(262'144) + 255;
  };
  const std::size_t to_server = capacity();
  connection_ = world_.kernel.connect(port_, to_server, capacity());
  if (!connection_) has_left_ = true;
  return connection_ != nullptr;
}

bool Client::is_over() const {
  return has_left_ || (connection_ && connection_->sides[0].is_reset) || is_ended_by_server();
}

bool Client::is_ended_by_server() const {
  if (!connection_) return false;
  const Stream& in = connection_->sides[0].in;
  return in.end_has_arrived && in.arrived.empty();
}

bool Client::is_tame() const {
  const bool stays = ending_ == Ending::kWaits || ending_ == Ending::kShutsDown;
  const bool is_hurt = world_.is_harmed || (connection_ && connection_->is_aborted);
  return stays && !never_reads_ && !is_hurt && is_connected();
}

std::string Client::place() const {
  return connection_ ? " at " + std::to_string(connection_->ports[0]) : " without connection";
}

void Client::fail(const std::string& what) { world_.kernel.fail(name() + ": " + what); }

void Client::act() {
  if (has_left_) return;
  if (!connection_) {
    connect();
    return;
  }
  Random& random = world_.random;
  if (random.chance(500)) send_some(random.between(1, most_at_once_));
  if (!is_slow_ && random.chance(500)) read_some(random.between(1, most_at_once_));
  if (pending().empty() && random.chance(200)) end(ending_);
}

void Client::send_some(std::size_t most) {
  sent_ += world_.kernel.write(*connection_, pending().substr(0, most));
}

bool Client::read_some(std::size_t most) {
  if (never_reads_ || connection_->sides[0].is_silent) return false;
  const std::string bytes = world_.kernel.read(*connection_, most);
  received(bytes);
  return !bytes.empty();
}

bool Client::settle() {
  if (has_left_) return false;
  if (!connection_ && !connect()) return false;
  const std::size_t before = sent_;
  for (Side& side : connection_->sides) side.in.capacity = std::max(side.in.capacity, kQuickly);
  send_some(std::string::npos);
  const bool has_read = read_some(std::string::npos);
  if (pending().empty() && ending_ == Ending::kShutsDown) end(ending_);
  return has_read || sent_ > before;
}

void Client::end(Ending ending) {
  switch (ending) {
    case Ending::kWaits: return;
    case Ending::kShutsDown: world_.kernel.shut(*connection_); return;
    case Ending::kCloses: world_.kernel.close(*connection_); break;
    case Ending::kResets: world_.kernel.reset(*connection_); break;
    case Ending::kVanishes: world_.kernel.vanish(*connection_); break;
  }
  has_left_ = true;
}

void Client::leave() {
  if (std::exchange(has_left_, true) || !connection_) return;
  if (!never_reads_) received(world_.kernel.read(*connection_, std::string::npos));
  world_.kernel.close(*connection_);
}

}  // namespace xr3::seeds
