// The monitor port over real sockets, with a manual clock. Server and clients share one thread,
// which waits for the expected bytes.
#include "server/monitor_port/port.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "cell/failure.hpp"
#include "protocol/json/source.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"
#include "tests/support/tcp_client.hpp"

namespace xr3 {
namespace {

using test::Client;

using namespace std::chrono_literals;

class MonitorPortTest : public testing::Test {
 protected:
  MonitorPortTest() {
    const tcp::endpoint any(asio::ip::make_address("127.0.0.1"), 0);
    EXPECT_FALSE(robot_port_.listen(any));
    EXPECT_FALSE(monitor_port_.listen(any));
  }
  ~MonitorPortTest() override {
    robot_port_.close();
    lines_.close();
    host_.turns.close();
    monitor_port_.close();
    lines_.abort();
    monitor_port_.abort();
    io_.run_for(5s);
    EXPECT_NE(monitor_port_.is_empty(), is_broken_);
  }

  Client monitor() { return {io_, monitor_port_.endpoint()}; }
  Client robot() { return {io_, robot_port_.endpoint()}; }
  /// Sends bytes, closes the sending side, and returns everything received.
  std::string exchange(std::string_view bytes) {
    Client client = monitor();
    client.send(bytes);
    client.half_close();
    return client.rest();
  }

  asio::io_context io_{1};
  bool fails_ = false;
  bool is_broken_ = false;  ///< a failure has left the loop: its session stays
  test::CellHost host_{io_};
  HostedCell& hosted_ = host_.add(test::rhino(), "main", [this](const CellEvent&, const Model&) {
    if (fails_) throw std::bad_alloc();
  });
  Cell& cell_ = hosted_.cell();
  LineSessions& lines_ = hosted_.lines();
  RobotPort& robot_port_ = hosted_.add_port({16});
  std::string trouble_;
  int acted_ = 0;
  AccessPolicy policy_;
  MonitorPort monitor_port_{io_,
                            host_.cells,
                            host_.worker,
                            policy_,
                            [this] { return trouble_; },
                            [this] { ++acted_; },
                            SocketLimits{}};
};

std::string call(const std::string& fn, const std::string& args) {
  return R"({"op":"call","id":1,"fn":")" + fn + R"(","args":)" + args + "}\n";
}

TEST_F(MonitorPortTest, SendsHelloAndThenRepliesInOrder) {
  Client client = monitor();
  client.send(
      "{\"op\":\"ping\",\"id\":1}\n{\"op\":\"get\",\"channel\":\"state\",\"fields\":[\"moving\"]}"
      "\n");
  EXPECT_EQ(client.json()["op"], "hello");
  EXPECT_EQ(client.line(), R"({"op":"pong","id":1})");
  EXPECT_EQ(client.line(),
            R"({"op":"state","cell":"main","epoch":0,"seq":1,"tick":0,"moving":false})");
}

TEST_F(MonitorPortTest, AHalfClosedClientGetsReplies) {
  const std::string text = exchange(R"({"op":"ping","id":"last"})");
  EXPECT_TRUE(text.ends_with("{\"op\":\"pong\",\"id\":\"last\"}\n")) << text;
  EXPECT_EQ(Json::parse(exchange(""))["op"], "hello");
}

TEST_F(MonitorPortTest, OtherProtocolsChangeNothing) {
  for (const std::string greeting :
       {"help\n", "\xEF\xBB{", "[1]\n", "\x16\x03\x01", "POST / HTTP/1.1\r\n\r\n"}) {
    exchange(greeting + call("reset", "{}"));
  }
  EXPECT_EQ(cell_.epoch(), 0);
  EXPECT_EQ(exchange("\x16\x03\x01"), "");
}

TEST_F(MonitorPortTest, BytesBeforeAStepTakeEffectFirst) {
  Client client = monitor();
  Client line = robot();
  client.send("{\"op\":\"ping\"}\n");
  client.line();
  client.line();
  for (int i = 0; i < 200; ++i) {
    line.send(i % 2 == 0 ? "E+1\r" : "E-1\r");
    client.send(call("run_until", R"({"idle":true,"max_ticks":1000,"fields":["joints"]})"));
    const Json value = client.json()["value"];
    ASSERT_EQ(value["state"]["joints"][1]["count"], i % 2 == 0 ? 1 : 0) << i;
    ASSERT_EQ(value["reached"], true);
  }
}

TEST_F(MonitorPortTest, BytesOnALineNotYetAcceptedTakeEffectFirst) {
  Client client = monitor();
  client.send("{\"op\":\"ping\"}\n");
  client.line();
  client.line();
  Client line = robot();
  line.send("E+1\r");
  client.send(call("run_until", R"({"idle":true,"max_ticks":1000,"fields":[]})"));
  EXPECT_EQ(client.json()["value"]["ran_ticks"], 10);  // a count at 110 a second
}

TEST_F(MonitorPortTest, AStepWaitsForItsBarrier) {
  Client line = robot();
  Client client = monitor();
  client.send(call(
      "step",
      R"({"ticks":10,"after":{"line":1,"bytes_in":5,"within_ms":60000},"fields":["moving"]})"));
  EXPECT_EQ(client.json()["op"], "hello");
  line.send("E+5");
  io_.run_for(30ms);
  EXPECT_EQ(cell_.state().tick, 0);
  line.send("0\r");
  EXPECT_EQ(
      client.line(),
      R"({"op":"result","id":1,"ok":true,"value":{"epoch":0,"tick":10,"state":{"moving":true}}})");
}

TEST_F(MonitorPortTest, ABarrierOnAMissingOrSilentLineFails) {
  const std::string after = R"({"ticks":10,"after":{"line":1,"bytes_in":5,"within_ms":1}})";
  EXPECT_NE(exchange(call("step", after)).find(R"("code":"no_such_line")"), std::string::npos);
  Client line = robot();
  const std::string text = exchange(call("step", after));
  EXPECT_NE(text.find(R"("code":"timeout","message":"line 1 has received 0 of 5 bytes)"),
            std::string::npos)
      << text;
  EXPECT_EQ(cell_.state().tick, 0);
}

TEST_F(MonitorPortTest, AClosedLineEndsItsBarrier) {
  Client client = monitor();
  {
    Client line = robot();
    client.send(call("step", R"({"ticks":10,"after":{"line":1,"bytes_in":5,"within_ms":60000}})"));
    EXPECT_EQ(client.json()["op"], "hello");
    io_.run_for(10ms);
  }
  EXPECT_EQ(client.json()["error"]["code"], "no_such_line");
}

TEST_F(MonitorPortTest, ARealClockRefusesAStepWithoutWaiting) {
  const std::string text = exchange(call("resume", "{}") +
                                    call("step", R"({"ticks":1,"after":{"line":9,"bytes_in":1}})"));
  EXPECT_NE(text.find(R"("code":"clock_running")"), std::string::npos) << text;
}

TEST_F(MonitorPortTest, TheSameStateHasTheSameSeq) {
  const std::string get = "{\"op\":\"get\",\"channel\":\"state\"}\n";
  Client one = monitor();
  Client two = monitor();
  one.send(get);
  two.send(get);
  one.line();
  two.line();
  const std::string first = one.line();
  EXPECT_EQ(first, two.line());
  two.send(call("step", R"({"ticks":1})") + get);
  two.line();
  EXPECT_EQ(two.json()["seq"], 2);
}

TEST_F(MonitorPortTest, ResetStartsANewEpoch) {
  const std::string text =
      exchange(call("step", R"({"ticks":9,"fields":[]})") + call("reset", "{}"));
  EXPECT_NE(text.find(R"("value":{"epoch":1,"tick":0}})"), std::string::npos) << text;
}

TEST_F(MonitorPortTest, ReportsReadinessByHttp) {
  const std::string request = "GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  EXPECT_TRUE(exchange(request).starts_with("HTTP/1.1 200 "));
  trouble_ = "the server is stopping";
  EXPECT_TRUE(exchange(request).starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(exchange("GET /readyz").starts_with("HTTP/1.1 400 "));
}

TEST_F(MonitorPortTest, StopsReadingAClientThatReadsNothing) {
  std::string flood;
  for (int i = 0; i < 2000; ++i) flood += "{\"op\":\"get\",\"channel\":\"state\"}\n";
  tcp::socket socket(io_);
  socket.connect(monitor_port_.endpoint());
  socket.non_blocking(true);
  std::size_t sent = 0;
  for (int turns = 0; turns < 20;) {  // until nothing is accepted for a while
    ErrorCode error;
    const std::size_t count = socket.write_some(asio::buffer(flood), error);
    sent += count;
    turns = count > 0 ? 0 : turns + 1;
    io_.run_one_for(20ms);
    ASSERT_LT(sent, 200U << 20);
  }
  Client other = monitor();
  other.send("{\"op\":\"ping\"}\n");
  EXPECT_EQ(other.json()["op"], "hello");
  EXPECT_EQ(other.line(), R"({"op":"pong","id":null})");
}

TEST_F(MonitorPortTest, EveryClientGetsAByeAtShutdown) {
  Client idle = monitor();
  Client waiting = monitor();
  Client line = robot();
  waiting.send(call("step", R"({"ticks":1,"after":{"line":1,"bytes_in":1,"within_ms":60000}})"));
  EXPECT_EQ(waiting.json()["op"], "hello");
  EXPECT_EQ(idle.json()["op"], "hello");
  robot_port_.close();
  lines_.close();
  monitor_port_.close();
  EXPECT_EQ(idle.rest(),
            "{\"op\":\"bye\",\"why\":\"shutdown\",\"message\":\"the server is stopping\"}\n");
  EXPECT_EQ(waiting.json()["why"], "shutdown");
  waiting.rest();
  for (Client* client : {&idle, &waiting}) client->half_close();
  io_.run_for(200ms);
  EXPECT_TRUE(monitor_port_.is_empty());
  EXPECT_EQ(cell_.state().tick, 0);
}

TEST_F(MonitorPortTest, AFailureOfTheCellEndsTheServer) {
  Client client = monitor();
  client.send(call("home", "{}"));
  fails_ = true;
  std::string what;
  try {
    io_.run_for(10s);
  } catch (const FatalFailure& failure) {
    what = failure.what();
  }
  fails_ = false;
  is_broken_ = true;
  EXPECT_EQ(what, "monitor: the cell: std::bad_alloc");
}

}  // namespace
}  // namespace xr3
