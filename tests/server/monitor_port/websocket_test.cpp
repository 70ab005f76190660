// WebSocket clients that are silent or do not read, over real sockets with short timeouts.
#include "server/monitor_port/websocket.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <string>
#include <string_view>

#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;

constexpr const char* kHandshake =
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
constexpr std::string_view kPing("\x89\0", 2);
constexpr std::string_view kPong("\x8a\x80\0\0\0\0", 6);

class WebsocketTest : public testing::Test {
 protected:
  void open(WebsocketPatience patience) {
    tcp::acceptor acceptor(io_, {asio::ip::make_address("127.0.0.1"), 0});
    acceptor.set_option(asio::socket_base::receive_buffer_size(4096));
    client_.open(tcp::v4());
    client_.set_option(asio::socket_base::receive_buffer_size(4096));
    client_.connect(acceptor.local_endpoint());
    tcp::socket accepted = acceptor.accept();
    accepted.non_blocking(true);
    accepted.set_option(asio::socket_base::send_buffer_size(4096));
    client_.non_blocking(true);
    server_ = std::make_shared<MonitorSocket>(std::move(accepted));
    websocket_ = Websocket::make(server_, monitor_content(service_), patience);
    asio::co_spawn(
        io_, [this] { return websocket_->run(kHandshake); },
        [this](const std::exception_ptr& failure) {
          EXPECT_FALSE(failure);
          websocket_->retire();
          is_over_ = true;
        });
  }
  ~WebsocketTest() override {
    if (server_) server_->close();
    if (websocket_) websocket_->wake();
    io_.run_for(1s);
    EXPECT_EQ(service_.counters().monitor_sessions, 0U);
  }

  /// Runs the server until it has sent `wanted` or the connection is closed. Returns all bytes.
  std::string until(std::string_view wanted) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    std::string received;
    while (!is_over_ && received.find(wanted) == std::string::npos) {
      EXPECT_LT(std::chrono::steady_clock::now(), deadline) << "nothing was received";
      if (HasFailure()) break;
      io_.restart();
      io_.run_one_for(20ms);
      char bytes[4096];
      ErrorCode error;
      received.append(bytes, client_.read_some(asio::buffer(bytes), error));
    }
    return received;
  }
  std::string rest() { return until("the end"); }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  HostedCell& hosted_ = host_.add(test::rhino());
  AccessPolicy policy_;
  MonitorService service_{io_, host_.cells, host_.worker, policy_};
  tcp::socket client_{io_};
  std::shared_ptr<MonitorSocket> server_;
  std::shared_ptr<Websocket> websocket_;
  bool is_over_ = false;
};

TEST_F(WebsocketTest, ASilentClientGetsAPingAndIsThenClosed) {
  open({100ms, 200ms});
  const std::string first = until("\"op\":\"hello\"");
  EXPECT_TRUE(first.starts_with("HTTP/1.1 101 ")) << first;
  EXPECT_EQ(first.find("Beast"), std::string::npos);
  until(kPing);
  EXPECT_FALSE(is_over_);
  rest();
  EXPECT_TRUE(is_over_);
}

TEST_F(WebsocketTest, AClientThatAnswersPingsStaysConnected) {
  open({200ms, 400ms});
  until("\"op\":\"hello\"");
  for (int i = 0; i < 4; ++i) {
    until(kPing);
    asio::write(client_, asio::buffer(kPong));
  }
  EXPECT_FALSE(is_over_);
}

TEST_F(WebsocketTest, AClientThatReadsNothingIsClosedEvenIfItSends) {
  open({50ms, 200ms});
  until("\"op\":\"hello\"");
  const std::string get = R"({"op":"get","channel":"model"})";
  std::string frame("\x81");
  frame.append(1, static_cast<char>(0x80 | get.size())).append(4, '\0').append(get);
  const auto deadline = std::chrono::steady_clock::now() + 10s;
  for (int i = 0; !is_over_ && std::chrono::steady_clock::now() < deadline; ++i) {
    ErrorCode error;
    if (i < 100) client_.write_some(asio::buffer(frame), error);
    if (i >= 100) client_.write_some(asio::buffer(kPong), error);
    io_.restart();
    io_.run_one_for(2ms);
  }
  EXPECT_TRUE(is_over_);
}

TEST_F(WebsocketTest, FinishWorksBeforeTheHandshakeEnds) {
  open({});
  websocket_->finish();
  rest();
  EXPECT_TRUE(is_over_);
}

}  // namespace
}  // namespace xr3
