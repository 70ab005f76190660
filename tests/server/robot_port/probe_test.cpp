// The server's probe of its own robot port, over real sockets: its results, and that it has no side
// effects.
#include "server/robot_port/probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "server/net/spawn.hpp"
#include "tests/support/models.hpp"
#include "tests/support/tcp_client.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;
using test::Client;

constexpr std::size_t kProbeLines = 2;

class RobotProbeTest : public testing::Test {
 protected:
  RobotProbeTest() { EXPECT_FALSE(port_.listen({asio::ip::make_address("127.0.0.1"), 0})); }
  ~RobotProbeTest() override {
    port_.close();
    lines_.close();
    lines_.abort();
    turns_.close();
    io_.restart();
    io_.run_for(5s);
  }

  /// Runs the probe and the server until there is a result.
  std::string trouble(RobotProbe& probe) {
    std::optional<std::string> result;
    ask(probe, result);
    run_until([&] { return result.has_value(); });
    return result.value_or("no result");
  }
  std::string trouble() {
    RobotProbe probe(io_, port_);  // without a previous result
    return trouble(probe);
  }
  void ask(RobotProbe& probe, std::optional<std::string>& result) {
    const auto take = [](RobotProbe& asked,
                         std::optional<std::string>& into) -> asio::awaitable<void> {
      into = co_await asked.trouble();
    };
    spawn_loop(io_.get_executor(), "test", take(probe, result));
  }
  /// The failure that the watchdog learns of.
  std::string failure() {
    RobotProbe probe(io_, port_);
    std::optional<std::string> result;
    const auto take = [](RobotProbe& asked,
                         std::optional<std::string>& into) -> asio::awaitable<void> {
      into = co_await asked.failure();
    };
    spawn_loop(io_.get_executor(), "test", take(probe, result));
    run_until([&] { return result.has_value(); });
    return result.value_or("no result");
  }
  template <class Condition>
  void run_until(Condition is_done) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (!is_done() && std::chrono::steady_clock::now() < deadline) {
      io_.restart();
      io_.run_one_for(20ms);
    }
    EXPECT_TRUE(is_done());
  }

  asio::io_context io_{1};
  std::vector<CellEvent> told_;
  int acted_ = 0;
  Cell cell_{"main", test::rhino(), SimClock::manual(),
             [this](const CellEvent& event, const Model&) { told_.push_back(event); }};
  LineTurns turns_{io_};
  LineSessions lines_{turns_, cell_, [this] { ++acted_; }};
  RobotPort port_{io_, cell_, lines_, {kProbeLines}};
};

TEST_F(RobotProbeTest, AnAnsweredLineIsHealthy) { EXPECT_EQ(trouble(), ""); }

TEST_F(RobotProbeTest, HasNoSideEffects) {
  Client before(io_, port_.endpoint());
  before.send("E?");
  EXPECT_EQ(before.bytes(1), " ");
  const State state = cell_.state();
  const int acted = acted_;
  EXPECT_EQ(trouble(), "");
  EXPECT_EQ(cell_.state(), state);
  EXPECT_EQ(acted_, acted);
  EXPECT_EQ(told_.size(), 1U) << "only the line of the client is reported";
  EXPECT_EQ(cell_.wires().next(), 3) << "E? and its answer";
  EXPECT_EQ(cell_.lines().size(), 1U);
  EXPECT_EQ(cell_.counters().lines_total, 1U);
  EXPECT_EQ(cell_.counters().bytes_in, 2U);
  EXPECT_EQ(cell_.find_line(kProbeLine), nullptr) << "it has ended";
  Client after(io_, port_.endpoint());
  after.send("E?");
  EXPECT_EQ(after.bytes(1), " ");
  EXPECT_NE(cell_.find_line(2), nullptr) << "the next line has the next number";
}

TEST_F(RobotProbeTest, ADisabledSimulatorIsHealthy) {
  Client client(io_, port_.endpoint());
  client.send("E?A@");
  EXPECT_EQ(client.bytes(1), " ");
  ASSERT_FALSE(cell_.state().enabled);
  EXPECT_EQ(trouble(), "");
  EXPECT_FALSE(cell_.state().enabled);
}

TEST_F(RobotProbeTest, ReportsThatEveryLineIsTaken) {
  {
    Client one(io_, port_.endpoint());
    Client two(io_, port_.endpoint());
    EXPECT_EQ(trouble(), "every line is in use: 2 are open (--max-lines)");
    EXPECT_EQ(failure(), "") << "the port works";
    two.send("E?");
    EXPECT_EQ(two.bytes(1), " ");
  }
  run_until([&] { return cell_.lines().empty(); });
  EXPECT_EQ(trouble(), "");
}

TEST_F(RobotProbeTest, LeavesTheLastLineToAProgram) {
  Client one(io_, port_.endpoint());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(trouble(), "");
  Client two(io_, port_.endpoint());
  two.send("E?");
  EXPECT_EQ(two.bytes(1), " ");
}

TEST_F(RobotProbeTest, ReportsAClosedPort) {
  port_.close();
  lines_.close();
  EXPECT_EQ(trouble(), "the robot port accepts no connection: Connection refused");
  EXPECT_EQ(failure(), trouble());
}

TEST_F(RobotProbeTest, APortThatDoesNotAnswerTimesOut) {
  asio::io_context stuck{1};  // never runs: connections wait in the kernel
  Cell cell("main", test::rhino(), SimClock::manual(), {});
  LineTurns turns(stuck);
  LineSessions lines(turns, cell, [] {});
  RobotPort port(stuck, cell, lines, {kProbeLines});
  EXPECT_FALSE(port.listen({asio::ip::make_address("127.0.0.1"), 0}));
  RobotProbe probe(io_, port);
  const auto started = std::chrono::steady_clock::now();
  EXPECT_EQ(trouble(probe), "the robot port does not answer an inquiry within 500 ms");
  EXPECT_GE(std::chrono::steady_clock::now() - started, RobotProbe::kPatience);
  port.close();
  stuck.run();
}

TEST_F(RobotProbeTest, ConcurrentRequestsShareOneProbe) {
  RobotProbe probe(io_, port_);
  std::vector<std::optional<std::string>> results(100);
  for (auto& each : results) ask(probe, each);
  run_until([&] {
    return std::all_of(results.begin(), results.end(), [](const auto& each) { return each == ""; });
  });
  port_.close();
  lines_.close();
  EXPECT_EQ(trouble(probe), "") << "the last outcome holds for a while";
  EXPECT_NE(trouble(), "");
}

}  // namespace
}  // namespace xr3
