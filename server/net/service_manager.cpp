#include "server/net/service_manager.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "protocol/text/whole_number.hpp"
#include "server/files/descriptor.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

using std::chrono::microseconds;

constexpr const char* kSocket = "NOTIFY_SOCKET";
constexpr const char* kTime = "WATCHDOG_USEC";
constexpr const char* kProcess = "WATCHDOG_PID";
// Minimum time between signs of life.
constexpr microseconds kMinPeriod{10'000};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// A whole number from 1; nullopt with a warning for any other text.
std::optional<std::int64_t> number_in(const char* name, const std::string& text) {
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max();
  if (const auto number = whole_number<std::int64_t>(text, 1, kMax)) return number;
  spdlog::warn("{} is ignored: it is a whole number from 1, set by the service manager", name);
  return std::nullopt;
}

std::optional<microseconds> watchdog_in_environment() {
  const std::string time = variable(kTime);
  const std::string process = variable(kProcess);
  if (time.empty()) return std::nullopt;
  if (!process.empty() && number_in(kProcess, process) != ::getpid()) return std::nullopt;
  const auto number = number_in(kTime, time);
  return number ? std::optional(microseconds(*number)) : std::nullopt;
}

std::string socket_in_environment() {
  std::string name = variable(kSocket);
  const bool is_usable = (name.starts_with('/') || name.starts_with('@')) &&
                         name.size() < sizeof(::sockaddr_un::sun_path);
  if (name.empty() || is_usable) return name;
  spdlog::warn(
      "{} is ignored: it is an absolute path or an abstract name with @ first, shorter than {} "
      "bytes",
      kSocket, sizeof(::sockaddr_un::sun_path));
  return "";
}

/// Sends one datagram. Returns an error number or 0.
int send_datagram(const std::string& name, std::string_view bytes) {
  ::sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path, sizeof address.sun_path - 1);
  if (name.front() == '@') address.sun_path[0] = '\0';
  const Descriptor file(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!file.is_open()) return errno;
  const auto length = static_cast<::socklen_t>(offsetof(::sockaddr_un, sun_path) + name.size());
  const ::ssize_t sent = ::sendto(file.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL,
                                  reinterpret_cast<const ::sockaddr*>(&address), length);
  return sent < 0 ? errno : 0;
}

}  // namespace

ServiceEnvironment service_environment() {
  return {socket_in_environment(), watchdog_in_environment()};
}

ServiceManager::ServiceManager(asio::io_context& io, ServiceEnvironment environment)
    : io_(io), environment_(std::move(environment)), timer_(io) {}

void ServiceManager::ready() {
  if (environment_.socket.empty()) return;
  send("READY=1");
  if (!environment_.watchdog) return;
  // Half of the time, as sd_watchdog_enabled(3) recommends.
  const microseconds period = std::max(*environment_.watchdog / 2, kMinPeriod);
  spawn_loop(io_.get_executor(), "the watchdog", show_life(period));
}

void ServiceManager::stopping() {
  is_stopping_ = true;
  timer_.cancel();
  send("STOPPING=1");
}

asio::awaitable<void> ServiceManager::show_life(microseconds period) {
  while (!is_stopping_) {
    timer_.expires_after(period);
    co_await timer_.async_wait(kAwait);
    co_await asio::post(io_, kAwait);
    if (!is_stopping_) send("WATCHDOG=1");
  }
}

// The server works without its manager, so a failure is only logged.
void ServiceManager::send(std::string_view state) {
  if (environment_.socket.empty()) return;
  const int error = send_datagram(environment_.socket, state);
  if (error == 0) return;
  spdlog::warn("the service manager does not receive {}: {}: {}", state, environment_.socket,
               std::strerror(error));
}

}  // namespace xr3
