// A connection of the monitor port over real sockets: how reading ends, and that the client gets
// the last bytes sent to it.
#include "server/net/socket.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <string>
#include <utility>

namespace xr3 {
namespace {

constexpr auto kAtOnce = std::chrono::milliseconds(0);

struct MonitorSocketTest : testing::Test {
  MonitorSocketTest() {
    tcp::acceptor acceptor(io, {asio::ip::make_address("127.0.0.1"), 0});
    client.connect(acceptor.local_endpoint());
    socket = std::make_unique<MonitorSocket>(acceptor.accept());
    socket->stream().non_blocking(true);
  }

  /// Runs until nothing is ready. Bytes on loopback arrive with the call that sends them.
  void settle() {
    io.restart();
    while (io.poll() > 0) {
    }
  }

  void start(asio::awaitable<void> session) {
    asio::co_spawn(io, std::move(session), asio::detached);
    settle();
  }

  void run_until(const bool& is_done) {
    io.restart();
    while (!is_done && io.run_one() > 0) {
    }
    ASSERT_TRUE(is_done);
  }

  void send(std::string_view bytes) { asio::write(client, asio::buffer(bytes)); }

  /// All further bytes that the client receives, and the error code that ends reading.
  std::pair<std::string, ErrorCode> rest() {
    std::string bytes;
    ErrorCode end;
    asio::read(client, asio::dynamic_buffer(bytes), end);
    return {bytes, end};
  }

  asio::awaitable<void> read_once() {
    got = co_await socket->read();
    is_read = true;
  }

  asio::awaitable<void> answer_and_linger() {
    got = co_await socket->read();
    is_read = true;
    co_await socket->send("408\n");
    co_await socket->linger();
    has_ended = true;
  }

  asio::io_context io{1};
  tcp::socket client{io};
  std::unique_ptr<MonitorSocket> socket;
  std::string got = "nothing read";
  bool is_read = false;
  bool has_ended = false;
};

TEST_F(MonitorSocketTest, AReadThatWaitsEndsWhenReadingStops) {
  start(read_once());
  EXPECT_FALSE(is_read);
  socket->stop_reading();
  settle();
  EXPECT_EQ(got, "");
  EXPECT_TRUE(socket->is_open());
  EXPECT_FALSE(socket->has_waited_enough());
}

TEST_F(MonitorSocketTest, WhatHasArrivedIsStillReadAfterReadingStops) {
  send("GET / HTTP/1.1\r\n");
  socket->stop_reading();
  start(read_once());
  EXPECT_EQ(got, "GET / HTTP/1.1\r\n");
  start(read_once());
  EXPECT_EQ(got, "");
  EXPECT_TRUE(socket->is_open());
}

TEST_F(MonitorSocketTest, ALostConnectionEndsReadingAndCloses) {
  socket->stop_reading();
  client.set_option(tcp::socket::linger(true, 0));
  client.close();  // resets the connection
  start(read_once());
  EXPECT_EQ(got, "");
  EXPECT_FALSE(socket->is_open());
}

TEST_F(MonitorSocketTest, AClientThatIsStillSendingGetsTheLastBytes) {
  socket->stop_reading_after(kAtOnce);
  start(answer_and_linger());
  run_until(is_read);
  EXPECT_EQ(got, "");
  EXPECT_TRUE(socket->has_waited_enough());
  settle();
  send("late");
  settle();
  send("later");
  EXPECT_EQ(rest(), std::pair(std::string("408\n"), ErrorCode(asio::error::eof)));
  EXPECT_FALSE(has_ended);
  client.close();
  run_until(has_ended);
  EXPECT_FALSE(socket->is_open());
}

TEST_F(MonitorSocketTest, ToStopReadingDoesNotEndLingering) {
  start(answer_and_linger());
  send("GET");
  settle();
  socket->stop_reading();
  settle();
  EXPECT_FALSE(has_ended);
  client.close();
  run_until(has_ended);
}

TEST_F(MonitorSocketTest, ATimeLimitThatIsCalledOffDoesNotStopReading) {
  socket->stop_reading_after(kAtOnce);
  socket->call_off();
  start(read_once());
  EXPECT_FALSE(is_read);
  send("more");
  settle();
  EXPECT_EQ(got, "more");
}

}  // namespace
}  // namespace xr3
