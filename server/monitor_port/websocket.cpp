#include "server/monitor_port/websocket.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <cassert>
#include <memory>
#include <optional>
#include <utility>

#include "server/monitor_port/handshake.hpp"
#include "server/net/acknowledge.hpp"
#include "server/service/open_session.hpp"

namespace xr3 {
namespace {

namespace beast = boost::beast;
namespace ws = beast::websocket;
using SteadyClock = std::chrono::steady_clock;

constexpr auto kNoDeadline = SteadyClock::time_point::max();
constexpr std::chrono::seconds kMaxHandshake{10};
// Time for the client to answer the close frame.
constexpr std::chrono::milliseconds kMaxCloseTime{500};
// While the client has yet to accept a message of this size, it gets no further answers.
constexpr std::size_t kLongMessage = std::size_t{64} * 1024;
// Requests handled before yielding to the event loop.
constexpr int kRequestsATurn = 64;

std::string_view text_in(const beast::flat_buffer& buffer) {
  return {static_cast<const char*>(buffer.cdata().data()), buffer.size()};
}

/// The leading ones of a byte of UTF-8: 1 if it continues a character, else the size of the one
/// that it begins, or 0 in ASCII.
int leading_ones(char byte) { return std::countl_one(static_cast<unsigned char>(byte)); }

/// Whether the last character of a UTF-8 text is incomplete. Beast checks all of a message but this
/// if its last frame is empty.
bool ends_within_character(std::string_view text) {
  const auto first =
      std::find_if(text.rbegin(), text.rend(), [](char byte) { return leading_ones(byte) != 1; });
  return first != text.rend() && leading_ones(*first) > first - text.rbegin() + 1;
}

/// The stream below Beast. Records when the connection last accepted bytes.
class TimedStream {
 public:
  using executor_type = tcp::socket::executor_type;

  explicit TimedStream(tcp::socket& socket) : socket_(socket) {}

  executor_type get_executor() { return socket_.get_executor(); }
  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    acknowledge_received(socket_.native_handle());
    return socket_.async_read_some(buffers, std::forward<Token>(token));
  }
  // Beast starts a write after the previous one has made progress.
  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    last_progress_ = SteadyClock::now();
    return socket_.async_write_some(buffers, std::forward<Token>(token));
  }
  SteadyClock::time_point last_progress() const { return last_progress_; }
  tcp::socket& socket() { return socket_; }

 private:
  tcp::socket& socket_;
  SteadyClock::time_point last_progress_;
};

// Beast finds these by argument-dependent lookup.
void beast_close_socket(TimedStream& wire) {
  ErrorCode ignored;
  wire.socket().close(ignored);
}
template <class Handler>
void async_teardown(beast::role_type role, TimedStream& wire, Handler&& handler) {
  ws::async_teardown(role, wire.socket(), std::forward<Handler>(handler));
}

ws::close_code code_of(std::optional<monitor::CloseReason> why) {
  if (why == monitor::CloseReason::kShutdown) return ws::close_code::going_away;
  if (why == monitor::CloseReason::kBadToken) return ws::close_code::policy_error;
  return ws::close_code::normal;
}

/// A client of the monitor.
class MonitorWebsocketSession final : public WebsocketSession {
 public:
  MonitorWebsocketSession(MonitorService& service, MessageSink& sink,
                          std::optional<std::string> cell)
      : session_(service, sink, std::move(cell)) {}

  asio::awaitable<void> handle(std::string_view message) override {
    return session_.handle(message);
  }
  std::optional<WebsocketMessage> next_output() override {
    monitor::Message text = session_.next_output();
    if (!text) return std::nullopt;
    return WebsocketMessage{WebsocketMessage::Type::kText, "", std::move(text)};
  }
  bool is_full() const override { return session_.client().is_full(); }
  std::size_t held_bytes() const override { return session_.client().held_bytes(); }
  void end(monitor::CloseReason why) override { session_.end(why); }
  std::optional<monitor::CloseReason> close_reason() const override {
    return session_.client().close_reason();
  }

 private:
  OpenSession session_;
};

std::array<asio::const_buffer, 2> buffers_of(const WebsocketMessage& message) {
  return {asio::buffer(message.head),
          message.text ? asio::buffer(*message.text) : asio::const_buffer()};
}

class BeastWebsocket final : public Websocket, private MessageSink {
 public:
  BeastWebsocket(std::shared_ptr<MonitorSocket> socket, WebsocketContent content,
                 WebsocketPatience patience);

  asio::awaitable<void> run(std::string head) override;
  void finish() override;
  std::size_t held_bytes() const override;
  void wake() override { progress_.cancel(); }
  void retire() override {
    assert(!socket_->is_open());
    session_.reset();
    watch_.cancel();
  }

 private:
  std::shared_ptr<BeastWebsocket> self() {
    return std::static_pointer_cast<BeastWebsocket>(shared_from_this());
  }
  asio::awaitable<void> read_messages();
  asio::awaitable<bool> read_text();
  bool is_full() const;
  asio::awaitable<void> until_there_is_room();

  void pump() override;
  void written(ErrorCode error);
  void close(ws::close_code code);
  void watch();
  void check_silence(SteadyClock::time_point now);
  void ping();

  std::shared_ptr<MonitorSocket> socket_;
  WebsocketContent content_;
  WebsocketPatience patience_;
  ws::stream<TimedStream> stream_;
  std::unique_ptr<WebsocketSession> session_;  ///< after the handshake
  beast::flat_buffer received_;                ///< bounded by the maximum message size
  std::optional<WebsocketMessage> message_;    ///< being written
  asio::steady_timer progress_;  ///< never expires; cancelled to resume waiting coroutines
  asio::steady_timer watch_;
  SteadyClock::time_point last_received_;  ///< when the client last sent anything
  bool is_reading_ = false;
  bool is_closing_ = false;
  bool is_pinging_ = false;
  bool is_pinged_ = false;  ///< a ping was sent after `last_received_`
};

BeastWebsocket::BeastWebsocket(std::shared_ptr<MonitorSocket> socket, WebsocketContent content,
                               WebsocketPatience patience)
    : socket_(std::move(socket)),
      content_(std::move(content)),
      patience_(patience),
      stream_(socket_->stream()),
      progress_(socket_->executor(), kNoDeadline),
      watch_(socket_->executor()) {
  // We use our own idle timer: Beast's would also run while a call waits and nothing is read.
  stream_.set_option(ws::stream_base::timeout{kMaxHandshake, ws::stream_base::none(), false});
  stream_.read_message_max(content_.max_message);
  stream_.auto_fragment(false);
}

// --- The handshake.

asio::awaitable<void> BeastWebsocket::run(std::string head) {
  assert(http::read_head(head).fault == http::HeadFault::kNone);
  stream_.control_callback(
      [this](ws::frame_type, beast::string_view) { last_received_ = SteadyClock::now(); });
  const bool accepted = co_await accept_handshake(stream_, head, content_.subprotocol);
  if (accepted && socket_->is_open()) {
    session_ = content_.open(static_cast<MessageSink&>(*this));
    last_received_ = SteadyClock::now();
    watch();
    pump();
    co_await read_messages();
  }
  watch_.cancel();
  socket_->close();
}

// --- In.

asio::awaitable<void> BeastWebsocket::read_messages() {
  for (int taken = 1;; ++taken) {
    co_await until_there_is_room();
    const bool is_text = co_await read_text();
    if (!is_text) co_return;
    co_await session_->handle(text_in(received_));
    received_.clear();
    if (taken % kRequestsATurn == 0) co_await asio::post(socket_->executor(), asio::use_awaitable);
  }
}

/// Reads the next message. False if the connection has ended, or was closed because of a message
/// that is no text in UTF-8.
asio::awaitable<bool> BeastWebsocket::read_text() {
  last_received_ = SteadyClock::now();  // nothing was read until now: no silence of the client
  is_reading_ = true;
  const auto [error, count] = co_await stream_.async_read(received_, kAwait);
  is_reading_ = false;
  last_received_ = SteadyClock::now();
  socket_->count_bytes(count);
  if (error) co_return false;
  if (stream_.got_text() && !ends_within_character(text_in(received_))) co_return true;
  if (!std::exchange(is_closing_, true)) {
    socket_->close_after(kMaxCloseTime);
    const bool is_text = stream_.got_text();
    co_await stream_.async_close(is_text ? ws::bad_payload : ws::unknown_data, kAwait);
  }
  co_return false;
}

bool BeastWebsocket::is_full() const {
  return session_->is_full() || (message_ && message_->size() >= kLongMessage);
}

asio::awaitable<void> BeastWebsocket::until_there_is_room() {
  while (is_full() && socket_->is_open()) co_await progress_.async_wait(kAwait);
}

// --- Out.

// Writes one message at a time, directly from the shared text; written() calls this for the next
// one.
void BeastWebsocket::pump() {
  if (message_ || is_closing_ || !session_ || !socket_->is_open()) return;
  message_ = session_->next_output();
  if (message_) {
    socket_->count_bytes(message_->size());
    stream_.text(message_->type == WebsocketMessage::Type::kText);
    stream_.async_write(buffers_of(*message_),
                        [self = self()](ErrorCode error, std::size_t) { self->written(error); });
  } else if (session_->close_reason()) {
    close(code_of(session_->close_reason()));
  }
}

void BeastWebsocket::written(ErrorCode error) {
  message_.reset();
  if (error && !is_closing_) socket_->close();
  pump();
  progress_.cancel();
}

void BeastWebsocket::close(ws::close_code code) {
  is_closing_ = true;
  socket_->close_after(kMaxCloseTime);
  stream_.async_close(code, [self = self()](ErrorCode) { self->socket_->close(); });
}

std::size_t BeastWebsocket::held_bytes() const {
  return received_.size() + (message_ ? message_->size() : 0) +
         (session_ ? session_->held_bytes() : 0);
}

void BeastWebsocket::finish() {
  if (!session_) return socket_->close();
  session_->end(monitor::CloseReason::kShutdown);
}

// --- Dead and stalled clients.

void BeastWebsocket::watch() {
  const auto of_silence =
      last_received_ + (is_pinged_ ? patience_.before_close : patience_.before_ping);
  const auto of_writing = stream_.next_layer().last_progress() + patience_.before_close;
  watch_.expires_at(message_ ? std::min(of_silence, of_writing) : of_silence);
  when_expired(watch_, [self = self()] {
    if (self->socket_->is_open()) self->check_silence(SteadyClock::now());
  });
}

void BeastWebsocket::check_silence(SteadyClock::time_point now) {
  if (!is_reading_) last_received_ = now;
  const auto stuck = now - stream_.next_layer().last_progress();
  const bool is_stuck = message_ && stuck >= patience_.before_close;
  const bool is_gone = is_pinged_ && now - last_received_ >= patience_.before_close;
  if (is_stuck || is_gone) return socket_->close();
  is_pinged_ = now - last_received_ >= patience_.before_ping;
  if (is_pinged_) ping();
  watch();
}

void BeastWebsocket::ping() {
  if (is_pinging_ || is_closing_) return;  // is_pinging_: the last ping is not sent yet
  is_pinging_ = true;
  stream_.async_ping({}, [self = self()](ErrorCode) { self->is_pinging_ = false; });
}

}  // namespace

WebsocketContent monitor_content(MonitorService& service, std::optional<std::string> cell) {
  return {http::subprotocols_of(http::kMonitorPath).front(), monitor::kMaxMessageBytes,
          [&service, cell = std::move(cell)](MessageSink& sink) {
            return std::make_unique<MonitorWebsocketSession>(service, sink, cell);
          }};
}

std::shared_ptr<Websocket> Websocket::make(std::shared_ptr<MonitorSocket> socket,
                                           WebsocketContent content, WebsocketPatience patience) {
  return std::make_shared<BeastWebsocket>(std::move(socket), std::move(content), patience);
}

}  // namespace xr3
