// The complete server: how it ends after a failure while clients of every kind are connected.
#include "server/app.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <csignal>
#include <list>
#include <new>
#include <string>
#include <thread>

#include "server/log.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using testing::HasSubstr;

constexpr const char* kHandshake =
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
constexpr const char* kRequests =
    R"({"op":"sub","channel":"state"})"
    "\n"
    R"({"op":"call","fn":"send","args":{"text":"E+50\r"}})"
    "\n"
    R"({"op":"call","fn":"step","args":{"ticks":1,"after":{"line":1,"bytes_in":99,)"
    R"("within_ms":60000}}})"
    "\n";
constexpr const char* kPastOfAThousandTicks = R"({"op":"call","fn":"step","args":{"ticks":1000}})"
                                              "\n";
constexpr const char* kBranch = R"({"op":"call","fn":"branch","args":{"tick":999}})"
                                "\n";
constexpr int kBranchingClients = 8;
constexpr int kBranchesOfAClient = 20;

/// Blocking clients of every kind, for use in another thread than the server's.
class Crowd {
 public:
  void come(std::uint16_t robot_port, std::uint16_t monitor_port) {
    talk(robot_port, "E?");
    talk(monitor_port, kRequests);
    talk(monitor_port, kHandshake);
    talk(monitor_port, "GET /camera.png HTTP/1.1\r\nHost: localhost\r\n\r\n");
    talk(monitor_port, "GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }

  /// Further branches are requested when this returns than the server has opened.
  void branch(std::uint16_t monitor_port) {
    std::string requests = kPastOfAThousandTicks;
    for (int i = 0; i < kBranchesOfAClient; ++i) requests += kBranch;
    for (int i = 0; i < kBranchingClients; ++i) talk(monitor_port, requests);
    read_until(sockets_.front(), "robot_port\":");
  }

 private:
  /// Connects, sends, and waits for the first byte of the answer.
  void talk(std::uint16_t port, const std::string& bytes) {
    tcp::socket& socket = sockets_.emplace_back(io_);
    socket.connect({asio::ip::address_v4::loopback(), port});
    asio::write(socket, asio::buffer(bytes));
    char first = 0;
    asio::read(socket, asio::buffer(&first, 1));
  }

  static void read_until(tcp::socket& socket, const std::string& text) {
    std::string bytes;
    asio::read_until(socket, asio::dynamic_buffer(bytes), text);
  }

  asio::io_context io_;
  std::list<tcp::socket> sockets_;
};

using Ending = std::pair<ExitCode, std::string>;  ///< the exit code and the log

/// Starts the server, lets clients `come`, then runs `work` in its loop.
template <class Come, class Work>
Ending ending(const Come& come, const Work& work) {
  ServeOptions options;
  options.robot_port = options.monitor_port = 0;
  options.clock.mode = ClockMode::kManual;
  start_log("critical", "");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Crowd crowd;
  std::thread clients;
  ExitCode code = ExitCode::kGood;
  {
    App app(options, {{test::rhino(), {}}}, "");
    asio::post(app.executor(), [&] {
      clients = std::thread([&] {
        come(crowd, app);
        asio::post(app.executor(), work);
      });
    });
    code = app.run();
  }
  clients.join();
  testing::internal::GetCapturedStdout();
  return {code, testing::internal::GetCapturedStderr()};
}

void come_all(Crowd& crowd, const App& app) {
  crowd.come(app.robot_endpoint().port(), app.monitor_endpoint().port());
}

void come_to_branch(Crowd& crowd, const App& app) { crowd.branch(app.monitor_endpoint().port()); }

TEST(App, AnExceptionInAHandlerGivesItsOwnExitCode) {
  const auto [code, log] = ending(come_all, [] { throw std::bad_alloc(); });
  EXPECT_EQ(code, ExitCode::kBroken);
  EXPECT_THAT(log, HasSubstr("the server has failed and ends: std::bad_alloc"));
}

TEST(App, ASignalGivesASuccessfulExit) {
  const auto [code, log] = ending(come_all, [] { std::raise(SIGTERM); });
  EXPECT_EQ(code, ExitCode::kGood);
  EXPECT_EQ(log, "");
}

// A cell that opened then would listen for ever.
TEST(App, ASignalEndsAServerThatMakesBranches) {
  const auto [code, log] = ending(come_to_branch, [] { std::raise(SIGTERM); });
  EXPECT_EQ(code, ExitCode::kGood);
  EXPECT_EQ(log, "");
}

}  // namespace
}  // namespace xr3
