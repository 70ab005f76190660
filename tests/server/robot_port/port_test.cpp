// The robot port over real sockets, with a manual clock: lines take turns, and none is forgotten
// although its socket reports readiness only once.
#include "server/robot_port/port.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <string>

#include "cell/failure.hpp"
#include "server/net/spawn.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"
#include "tests/support/tcp_client.hpp"

namespace xr3 {
namespace {

using test::Client;

constexpr std::size_t kMaxLines = 4;
const std::string kJunk(std::size_t{100} * 1024, 'z');

std::string pictures(std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += "A**";
  return all;
}
constexpr std::size_t kPictureReply = 192 * 192 / 6;

class RobotPortTest : public testing::Test {
 protected:
  RobotPortTest() { EXPECT_FALSE(port_.listen({asio::ip::address_v4::loopback(), 0})); }
  ~RobotPortTest() override {
    port_.close();
    lines_.close();
    lines_.abort();
    turns_.close();
    io_.run();  // returns: nothing of the port is left
  }

  /// Runs the loop and returns the message of the failure that leaves it.
  std::string failure() {
    fails_ = true;
    std::string what;
    try {
      io_.restart();
      io_.run_for(std::chrono::seconds(10));
    } catch (const FatalFailure& failure) {
      what = failure.what();
    }
    fails_ = false;
    return what;
  }
  /// The number of bytes that a line has received so far.
  std::uint64_t received(LineId line) const { return cell_.bytes_in(line).value_or(0); }
  /// Runs all pending work.
  void settle() {
    io_.restart();
    while (io_.poll() > 0) {
    }
  }
  /// Runs the loop until the bytes that have arrived are read.
  void read_arrived() {
    bool is_read = false;
    spawn_session(io_.get_executor(), "lines", lines_.read_arrived(), [&] { is_read = true; });
    io_.restart();
    while (!is_read) io_.run_one();
  }

  asio::io_context io_{1};
  bool fails_ = false;
  Cell cell_{"main",
             std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                           test::workcell_named("rhino-xr3"), Profile::kPaper),
             SimClock::manual()};
  test::OnEvent on_event_{cell_, [this](const CellEvent&) {
                            if (fails_) throw std::bad_alloc();
                          }};
  LineTurns turns_{io_};
  LineSessions lines_{turns_, cell_, [] {}};
  RobotPort port_{io_, cell_, lines_, {kMaxLines, Guard::kOff}};
};

TEST_F(RobotPortTest, BytesAndTheEndArriveTogether) {
  Client client(io_, port_.endpoint());
  client.send("E+5\rE?");
  client.half_close();
  EXPECT_EQ(client.rest(), "%");
  settle();
  EXPECT_TRUE(cell_.lines().empty());
}

TEST_F(RobotPortTest, TheEndArrivesAlone) {
  Client client(io_, port_.endpoint());
  client.send("E?");
  EXPECT_EQ(client.bytes(1), " ");
  client.half_close();
  EXPECT_EQ(client.rest(), "");
  settle();
  EXPECT_TRUE(cell_.lines().empty());
}

TEST_F(RobotPortTest, BytesSentBeforeTheLineOpensTakeEffect) {
  Client client(io_, port_.endpoint());
  client.send("E+5\rE?");
  read_arrived();
  EXPECT_EQ(received(1), 6U) << "accepted and read";
  EXPECT_EQ(client.bytes(1), "%");
}

TEST_F(RobotPortTest, AFloodDoesNotBlockOtherLines) {
  Client flood(io_, port_.endpoint());
  Client other(io_, port_.endpoint());
  settle();
  flood.send(kJunk);
  other.send("E?");
  EXPECT_EQ(other.bytes(1), " ");
  EXPECT_LT(received(1), kJunk.size() / 2) << "the flood was not read at once";
  settle();
  EXPECT_EQ(received(1), kJunk.size())
      << "the rest arrives although the socket reported readiness only once";
}

TEST_F(RobotPortTest, AFloodOfImageInquiriesDoesNotBlockOtherLines) {
  Client flood(io_, port_.endpoint());
  Client other(io_, port_.endpoint());
  settle();
  const std::string asked = pictures(500);  // replies that fill a socket's buffer, or more
  flood.send(asked);
  other.send("E?");
  EXPECT_EQ(other.bytes(1), " ");
  EXPECT_LT(received(1), pictures(100).size()) << "a turn is as long as its work, not as its bytes";
  EXPECT_EQ(flood.bytes(500 * kPictureReply).size(), 500 * kPictureReply) << "no reply is lost";
  settle();
  EXPECT_EQ(received(1), asked.size());
}

TEST_F(RobotPortTest, ManyFloodsDoNotBlockOtherLines) {
  std::vector<std::unique_ptr<Client>> floods;
  for (std::size_t i = 1; i < kMaxLines; ++i)
    floods.push_back(std::make_unique<Client>(io_, port_.endpoint()));
  Client other(io_, port_.endpoint());
  settle();
  for (const auto& flood : floods) flood->send(kJunk);
  for (int i = 0; i < 3; ++i) io_.poll_one();
  other.send("E?");
  EXPECT_EQ(other.bytes(1), " ");
  settle();
  for (LineId line = 1; line < kMaxLines; ++line) EXPECT_EQ(received(line), kJunk.size()) << line;
}

TEST_F(RobotPortTest, ABarrierLimitsImageReplies) {
  Client client(io_, port_.endpoint());
  settle();
  const std::string asked = pictures(500);
  client.send(asked);
  read_arrived();
  const std::uint64_t answered = received(1) / 3 * kPictureReply;
  EXPECT_GE(answered, SerialLine::kFullOutbox);
  EXPECT_LE(answered, ArrivedBytes::kMaxReplies + 2 * SerialLine::kFullOutbox);
  EXPECT_EQ(client.bytes(500 * kPictureReply).size(), 500 * kPictureReply)
      << "the rest follows without another request";
  settle();
  EXPECT_EQ(received(1), asked.size());
}

TEST_F(RobotPortTest, ABarrierReadsAllArrivedBytes) {
  Client flood(io_, port_.endpoint());
  Client other(io_, port_.endpoint());
  settle();
  flood.send(kJunk);
  other.send("E+5\r");
  read_arrived();
  EXPECT_EQ(received(1), kJunk.size());
  EXPECT_EQ(received(2), 4U);
}

TEST_F(RobotPortTest, LinesAboveTheMaximumAreClosed) {
  std::vector<std::unique_ptr<Client>> lines;
  for (std::size_t i = 0; i < kMaxLines; ++i)
    lines.push_back(std::make_unique<Client>(io_, port_.endpoint()));
  Client beyond(io_, port_.endpoint());
  EXPECT_EQ(beyond.rest(), "");
  EXPECT_EQ(cell_.lines().size(), kMaxLines);
  EXPECT_TRUE(port_.is_full());
  lines.pop_back();
  settle();
  EXPECT_FALSE(port_.is_full());
}

TEST_F(RobotPortTest, ClosingSendsPendingReplies) {
  Client client(io_, port_.endpoint());
  client.send("E+5\rE?");
  read_arrived();
  port_.close();
  lines_.close();
  EXPECT_EQ(client.rest(), "%");
  EXPECT_TRUE(lines_.is_empty());
}

// --- The owner of the port.

class OwnedPortTest : public testing::Test {
 protected:
  OwnedPortTest() { EXPECT_FALSE(port_.listen({asio::ip::address_v4::loopback(), 0})); }
  ~OwnedPortTest() override {
    port_.close();
    lines_.close();
    lines_.abort();
    turns_.close();
    io_.restart();
    io_.run();
  }
  /// A client with another address than Client has.
  tcp::socket stranger() {
    tcp::socket socket(io_);
    socket.open(tcp::v4());
    socket.bind({asio::ip::make_address("127.0.0.2"), 0});
    socket.connect(port_.endpoint());
    return socket;
  }
  void settle() {
    io_.restart();
    while (io_.poll() > 0) {
    }
  }

  asio::io_context io_{1};
  Cell cell_{"main", test::rhino(), SimClock::manual()};
  LineTurns turns_{io_};
  LineSessions lines_{turns_, cell_, [] {}};
  RobotPort port_{io_, cell_, lines_, {kMaxLines, Guard::kNormal, PeerCounts(), WallNs{0}}};
};

TEST_F(OwnedPortTest, TheFirstAddressThatSpeaksKeepsThePort) {
  tcp::socket silent = stranger();
  Client first(io_, port_.endpoint());
  settle();
  EXPECT_EQ(cell_.lines().size(), 2U);
  EXPECT_FALSE(port_.owner());
  first.send("E?");
  EXPECT_EQ(first.bytes(1), " ");
  EXPECT_EQ(port_.owner(), asio::ip::address_v4::loopback());
  EXPECT_EQ(cell_.lines().size(), 1U) << "the line that has not spoken is closed";
  tcp::socket late = stranger();
  settle();
  EXPECT_EQ(cell_.lines().size(), 1U);
  EXPECT_EQ(port_.counters().other_peers, 2U);
}

TEST_F(OwnedPortTest, IsFreeAgainAfterTheLastLine) {
  {
    Client first(io_, port_.endpoint());
    first.send("E?");
    EXPECT_EQ(first.bytes(1), " ");
  }
  for (int i = 0; i < 100 && port_.owner(); ++i) {
    io_.restart();
    io_.run_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(port_.owner());
  tcp::socket other = stranger();
  settle();
  EXPECT_EQ(cell_.lines().size(), 1U);
}

// --- Failures.

TEST_F(RobotPortTest, AFailureInATurnIsReported) {
  Client client(io_, port_.endpoint());
  client.send("E?");
  EXPECT_EQ(client.bytes(1), " ");
  client.send("junk");
  EXPECT_EQ(failure(), "the serial lines: the cell: std::bad_alloc");
}

TEST_F(RobotPortTest, AFailureInAcceptingIsReported) {
  Client client(io_, port_.endpoint());
  EXPECT_EQ(failure(), "the robot port: the cell: std::bad_alloc");
}

}  // namespace
}  // namespace xr3
