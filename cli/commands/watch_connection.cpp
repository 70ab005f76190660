#include "cli/commands/watch_connection.hpp"

#include <boost/asio/connect.hpp>
#include <chrono>
#include <utility>

#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr std::chrono::seconds kMaxWait{5};
/// Maximum size of a line, enough for an image of the maximum size.
constexpr std::size_t kMaxLineBytes = std::size_t{32} << 20U;

}  // namespace

WatchConnection::WatchConnection(asio::io_context& context, const WatchOptions& options,
                                 watch::WatchModel& model)
    : context_(context),
      options_(options),
      model_(model),
      resolver_(context),
      connecting_(context),
      deadline_(context) {}

asio::awaitable<std::string> WatchConnection::run(std::function<void()> on_news) {
  close_when_due();
  if (std::string trouble = co_await connect(); !trouble.empty()) {
    deadline_.cancel();
    co_return trouble;
  }
  const std::shared_ptr<MonitorSocket> socket = socket_;
  line_.clear();
  bool is_greeted = false;
  send(model_.opening());
  while (socket->is_open()) {
    const std::string_view bytes = co_await socket->read();
    if (bytes.empty() || !feed(bytes)) break;
    has_heard_ = true;
    if (!is_greeted && !model_.known().server.empty()) {
      is_greeted = true;
      ask_for_life();
    }
    on_news();
  }
  deadline_.cancel();
  socket->close();
  socket_.reset();
  co_return close_reason(is_greeted);
}

asio::awaitable<std::string> WatchConnection::connect() {
  const auto [unknown, places] =
      co_await resolver_.async_resolve(options_.address.host, options_.address.port, kAwait);
  if (is_late_) co_return options_.address.text + " does not answer";
  if (unknown) co_return "no address is known for " + options_.address.host;
  connecting_ = tcp::socket(context_);
  const auto [refused, place] = co_await asio::async_connect(connecting_, places, kAwait);
  if (is_late_) co_return options_.address.text + " does not answer";
  if (refused) {
    co_return "cannot connect to " + options_.address.text + " (" + refused.message() + ")";
  }
  ErrorCode ignored;
  connecting_.non_blocking(true, ignored);
  connecting_.set_option(tcp::no_delay(true), ignored);
  socket_ = std::make_shared<MonitorSocket>(std::move(connecting_));
  co_return std::string{};
}

/// Passes every complete line to the model. Returns false if the incomplete line is too long.
bool WatchConnection::feed(std::string_view bytes) {
  for (std::size_t end = 0; (end = bytes.find('\n')) != std::string_view::npos;) {
    line_ += bytes.substr(0, end);
    bytes.remove_prefix(end + 1);
    for (const std::string& request : model_.handle(line_)) send(request);
    line_.clear();
  }
  line_ += bytes;
  return line_.size() <= kMaxLineBytes;
}

std::string WatchConnection::close_reason(bool is_greeted) const {
  const std::string& message = model_.known().last_message;
  if (model_.has_left() && !message.empty()) return message;
  if (!is_greeted) return options_.address.text + " is no monitor port: it sent no hello";
  if (is_late_) return options_.address.text + " does not answer";
  return "the connection to " + options_.address.text + " is lost";
}

void WatchConnection::send(const std::string& bytes) {
  if (!socket_) return;
  unsent_ += bytes;
  if (is_sending_) return;
  is_sending_ = true;
  spawn_loop(context_.get_executor(), "watch", send_all(socket_));
}

asio::awaitable<void> WatchConnection::send_all(std::shared_ptr<MonitorSocket> socket) {
  while (!unsent_.empty()) {
    const std::string bytes = std::exchange(unsent_, {});
    const bool is_sent = co_await socket->send(bytes);
    if (!is_sent) break;
  }
  unsent_.clear();
  is_sending_ = false;
}

void WatchConnection::close_when_due() {
  is_late_ = false;
  run_after(deadline_, kMaxWait, [this] { close_late(); });
}

void WatchConnection::close_late() {
  is_late_ = true;
  close();
}

// Sends a ping. A server sends nothing while nothing happens, so only a ping shows whether it still
// runs.
void WatchConnection::ask_for_life() {
  has_heard_ = false;
  send(model_.ping());
  run_after(deadline_, kMaxWait, [this] { has_heard_ ? ask_for_life() : close_late(); });
}

void WatchConnection::close() {
  ErrorCode ignored;
  deadline_.cancel();
  resolver_.cancel();
  connecting_.close(ignored);
  if (socket_) socket_->close();
}

}  // namespace xr3
