// Monitor clients over JSON lines and over WebSocket.
#include <utility>

#include "tests/seeds/client.hpp"
#include "tests/seeds/requests.hpp"

namespace xr3::seeds {
namespace {

/// The common part of both transports.
class MonitorClient : public Client {
 public:
  MonitorClient(World& world, int number)
      : Client(world, world.monitor_port), number_(number), requests_(world, number) {}

  void verify(bool is_complete) override {
    if (!is_complete || !is_tame() || world_.has_jumped || world_.is_crowded) return;
    if (messages().unanswered() > 0) {
      fail(std::to_string(messages().unanswered()) + " requests have no reply" +
           (is_ended_by_server() ? "; the server has ended the connection: " + end_ : "") +
           "; the last message is " + last_ + ", then " + in_);
    }
  }

 protected:
  bool expects_more() const override { return messages().unanswered() > 0; }
  const Messages& messages() const { return requests_messages_; }
  std::string next_request() { return requests_.next(); }
  void handle(std::string_view message) {
    last_ = message.substr(0, 300);
    const std::string wrong = requests_messages_.feed(message);
    if (!wrong.empty()) fail(wrong);
  }
  void note_end(std::string_view why) { end_ = why; }
  std::size_t request_count() {
    const std::size_t most = world_.random.chance(50) ? 400 : 12;
    return world_.random.spread(most);
  }

  int number_;

 private:
  std::string end_;   ///< the server's reason
  std::string last_;  ///< message, cut
  Requests requests_;
  Messages& requests_messages_ = requests_.messages();
};

class JsonLinesClient final : public MonitorClient {
 public:
  JsonLinesClient(World& world, int number) : MonitorClient(world, number) {
    for (std::size_t count = request_count(); count > 0; --count)
      queue(next_request() + world.random.any_of({"\n", "\n", "\r\n", "\n\n"}));
  }
  std::string name() const override {
    return "monitor client " + std::to_string(number_) + place();
  }

 protected:
  void received(std::string_view bytes) override {
    in_.append(bytes);
    for (std::size_t end; (end = in_.find('\n')) != std::string::npos; in_.erase(0, end + 1))
      handle(std::string_view(in_).substr(0, end));
  }
};

// RFC 6455, with the key of its example.
class WebsocketClient final : public MonitorClient {
 public:
  WebsocketClient(World& world, int number) : MonitorClient(world, number) {
    left_ = request_count();
    // A WebSocket without its close frame is lost, so the server answers nothing more.
    if (ending_ == Ending::kShutsDown) ending_ = Ending::kCloses;
    queue(
        "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  }
  std::string name() const override {
    return "WebSocket client " + std::to_string(number_) + place();
  }

  void act() override {
    request();
    Client::act();
  }
  bool settle() override {
    const bool has_requested = request();
    return Client::settle() || has_requested;
  }
  bool is_done() const override { return is_over() || (left_ == 0 && Client::is_done()); }

 protected:
  void received(std::string_view bytes) override {
    in_.append(bytes);
    if (!is_upgraded_ && !read_head()) return;
    while (read_frame()) {
    }
  }

 private:
  bool request() {
    if (!is_upgraded_ || left_ == 0 || is_closed_) return false;
    --left_;
    frame(1, next_request());
    return true;
  }

  bool read_head() {
    const std::size_t end = in_.find("\r\n\r\n");
    if (end == std::string::npos) return false;
    const std::string head = in_.substr(0, end + 4);
    in_.erase(0, head.size());
    const bool is_refused = (world_.is_crowded && head.starts_with("HTTP/1.1 503")) ||
                            head.starts_with("HTTP/1.1 408");  // it was too slow
    is_upgraded_ = head.starts_with("HTTP/1.1 101") &&
                   head.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") != std::string::npos;
    if (!is_upgraded_ && !is_refused && !world_.is_harmed && !world_.is_stopping)
      fail("no upgrade: " + head);
    if (is_upgraded_) return true;
    left_ = 0;
    is_closed_ = true;
    return false;
  }

  /// Frames of a server: not masked, not fragmented.
  bool read_frame() {
    if (is_closed_ || in_.size() < 2) return false;
    const auto byte = [this](std::size_t i) { return static_cast<unsigned char>(in_[i]); };
    const std::size_t length_bytes = byte(1) < 126 ? 0 : byte(1) == 126 ? 2 : 8;
    if (in_.size() < 2 + length_bytes) return false;
    std::size_t size = length_bytes > 0 ? 0 : byte(1);
    for (std::size_t i = 0; i < length_bytes; ++i) size = size * 256 + byte(2 + i);
    if (in_.size() - 2 - length_bytes < size) return false;
    const std::string payload = in_.substr(2 + length_bytes, size);
    const int kind = byte(0);
    in_.erase(0, 2 + length_bytes + size);
    handle_frame(kind, payload);
    return true;
  }

  void handle_frame(int kind, const std::string& payload) {
    switch (kind) {
      case 0x81: return handle(payload);
      case 0x88:
        is_closed_ = true;
        left_ = 0;
        note_end(payload);
        return frame(8, payload);
      case 0x89: return frame(10, payload);
      case 0x8A: return;
      default: return fail("a frame of kind " + std::to_string(kind));
    }
  }

  void frame(int kind, const std::string& payload) {
    std::string bytes(1, static_cast<char>(0x80 + kind));
    const std::size_t size = payload.size();
    if (size < 126) {
      bytes += static_cast<char>(0x80 + size);
    } else {
      bytes += {static_cast<char>(0x80 + 126), static_cast<char>(size / 256),
                static_cast<char>(size % 256)};
    }
    const std::string mask = "\x11\x22\x33\x44";
    bytes += mask;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(payload[i] ^ mask[i % 4]);
    queue(bytes);
  }

  std::size_t left_ = 0;
  bool is_upgraded_ = false;
  bool is_closed_ = false;
};

}  // namespace

ClientPtr make_monitor(World& world, int number) {
  return std::make_unique<JsonLinesClient>(world, number);
}

ClientPtr make_websocket(World& world, int number) {
  return std::make_unique<WebsocketClient>(world, number);
}

}  // namespace xr3::seeds
