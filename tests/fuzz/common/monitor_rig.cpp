#include "tests/fuzz/common/monitor_rig.hpp"

#include <fcntl.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "protocol/monitor/heading.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz {
namespace {

constexpr const char* kToken = "a token that no input contains";
constexpr std::chrono::seconds kMaxWait{2};
constexpr std::chrono::milliseconds kShortestLimit{500};  // in server/net/socket.cpp
constexpr int kMaxTries = 3;

/// A log in which an error is a defect: a session that fails is only closed and logged.
class FailingSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    require(message.level < spdlog::level::err, text.c_str());
  }
  void flush_() override {}
};

}  // namespace

/// The client's end of a pair of sockets.
class MonitorRig::Peer {
 public:
  Peer() {
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends_.data()) == 0,
            "the machine has a pair of sockets left");
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() { ::close(ends_[0]); }

  /// The server's end. The caller owns it.
  int server() const { return ends_[1]; }

  /// Sends as much as the server accepts. Returns the number of bytes; nullopt if the server has
  /// closed.
  std::optional<std::size_t> send(std::string_view bytes) const {
    const ssize_t sent = ::send(ends_[0], bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN) return std::nullopt;
    return static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
  }
  void shut_down() const { ::shutdown(ends_[0], SHUT_WR); }

  /// Receives what has arrived. Returns whether it is anything.
  bool receive() {
    static std::array<char, 64 * 1024> bytes;
    const std::size_t before = received_.size();
    for (std::size_t count = bytes.size(); count == bytes.size();) {
      const ssize_t result = ::recv(ends_[0], bytes.data(), bytes.size(), 0);
      count = static_cast<std::size_t>(std::max<ssize_t>(result, 0));
      received_.append(bytes.data(), count);
    }
    return received_.size() > before;
  }
  std::string take_received() { return std::move(received_); }

 private:
  std::array<int, 2> ends_{};
  std::string received_;
};

MonitorRig& MonitorRig::shared() {
  static MonitorRig rig(ReadAccess::kFree);
  return rig;
}

MonitorRig& MonitorRig::closed() {
  static MonitorRig rig(ReadAccess::kWithToken);
  return rig;
}

MonitorRig::MonitorRig(ReadAccess reading)
    : policy_({{}, reading, kToken}),
      service_(io_, host_.cells, host_.worker, policy_),
      resources_(
          service_, policy_, [] { return std::string(); }, [this] { return service_.counters(); }),
      foxglove_(io_),
      context_{.service = service_,
               .resources = resources_,
               .foxglove = foxglove_,
               .has_room = [] { return true; },
               .speaks_http = [](const asio::ip::address&) { return false; },
               .tls_refused = [] {},
               .ended = [this](const std::shared_ptr<MonitorConnection>&) { is_over_ = true; }} {
  host_.add(test::rhino());
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("fuzz", std::make_shared<FailingSink>()));
}

/// Runs what the event loop can run now. Returns whether it is anything.
bool MonitorRig::run_ready() {
  io_.restart();
  return io_.poll() > 0;
}

/// Waits until the worker has done all work that was begun. Its results are then in the event loop.
void MonitorRig::wait_for_worker() {
  asio::co_spawn(waiting_, service_.worker().run([] { return true; }), asio::detached);
  waiting_.restart();
  waiting_.run();
}

/// Runs the server and receives, until neither has anything to do.
void MonitorRig::exhaust(Peer& peer) {
  for (bool is_busy = true; is_busy;) {
    const bool has_run = run_ready();
    is_busy = peer.receive() || has_run;
  }
}

/// The same, and the worker has nothing to do either.
void MonitorRig::settle(Peer& peer) {
  do {
    exhaust(peer);
    wait_for_worker();
  } while (run_ready());
  peer.receive();
}

/// Sends all bytes, unless the server closes.
void MonitorRig::send(Peer& peer, std::string_view bytes) {
  for (bool is_full = false; !bytes.empty();) {
    const auto sent = peer.send(bytes);
    if (!sent) return;
    require(*sent > 0 || !is_full, "the server reads, or closes");
    is_full = *sent == 0;
    bytes.remove_prefix(*sent);
    is_full ? settle(peer) : exhaust(peer);
  }
}

/// Runs the server until the connection ends or only listens. Waits for the worker if the server
/// does, and for time only after a wrong token.
void MonitorRig::finish(Peer& peer, const MonitorConnection& connection) {
  const auto is_done = [&] { return is_over_ || connection.only_listens(); };
  const auto deadline = std::chrono::steady_clock::now() + kMaxWait;
  exhaust(peer);
  if (!is_done()) settle(peer);
  while (!is_done()) {
    require(std::chrono::steady_clock::now() < deadline, "a connection ends when the client has");
    io_.restart();
    io_.run_one_for(kMaxWait);
    settle(peer);
  }
}

// If the machine pauses, a time limit of the server can expire. Then the conversation is repeated.
std::string MonitorRig::converse(const Pieces& pieces) {
  std::string received;
  for (int tries = 0; tries < kMaxTries; ++tries) {
    const auto start = std::chrono::steady_clock::now();
    received = converse_once(pieces);
    if (std::chrono::steady_clock::now() - start < kShortestLimit) break;
  }
  return received;
}

std::string MonitorRig::converse_once(const Pieces& pieces) {
  Peer peer;
  is_over_ = false;
  tcp::socket socket(io_, tcp::v4(), peer.server());
  socket.non_blocking(true);
  const auto connection = std::make_shared<MonitorConnection>(
      std::move(socket), tcp::endpoint(), context_, std::make_shared<const asio::ip::address>());
  connection->start();
  for (const std::string& piece : pieces) send(peer, piece);
  peer.shut_down();
  finish(peer, *connection);
  connection->abort();
  exhaust(peer);
  if (!is_over_) settle(peer);
  require(is_over_, "an aborted connection ends");
  return peer.take_received();
}

http::Answer MonitorRig::answer(const http::HttpRequest& request) {
  http::Answer answer;
  bool is_answered = false;
  asio::co_spawn(
      io_,
      [&]() -> asio::awaitable<void> {
        answer = co_await resources_.answer(request);
        is_answered = true;
      },
      [](const std::exception_ptr& failure) { require(!failure, "an answer does not fail"); });
  run_ready();
  for (bool is_busy = true; !is_answered && is_busy; is_busy = run_ready()) wait_for_worker();
  require(is_answered, "an answer waits only for the worker");
  return answer;
}

bool shows_the_cell(std::string_view messages) {
  return messages.find(R"("cell":)") != messages.npos ||
         messages.find(R"("tick":)") != messages.npos;
}

bool would_wait(std::string_view message) { return monitor::heading_of(message).op == "auth"; }

}  // namespace xr3::fuzz
