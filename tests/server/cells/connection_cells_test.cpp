// Connections that get a cell of their own, over real sockets: when it appears, and when it goes.
#include "server/cells/connection_cells.hpp"

#include <gtest/gtest.h>

#include <boost/asio/post.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"
#include "tests/support/tcp_client.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;
using test::Client;

class ConnectionCellsTest : public testing::Test {
 protected:
  explicit ConnectionCellsTest(ConnectionCellsRules rules = {4, 3, WallNs{3'600'000'000'000}})
      : connections_(
            io_, std::move(rules), [this](const std::string& name) { return open(name); },
            [this](const CellPtr& cell) { close(cell); }) {
    EXPECT_FALSE(connections_.listen({asio::ip::address_v4::loopback(), 0}));
  }
  ~ConnectionCellsTest() override {
    connections_.close();
    for (const CellPtr& each : std::vector<CellPtr>(host_.cells.all())) each->lines().abort();
    host_.turns.close();
    io_.restart();
    io_.run();  // returns: nothing waits any more
    for (const CellPtr& each : host_.cells.all()) each->lines().drop();
  }

  CellPtr open(const std::string& name) {
    return host_.add(test::rhino(), name).shared_from_this();
  }
  void close(const CellPtr& cell) {
    host_.cells.remove(*cell);
    cell->retire();
    asio::post(io_, [cell] {});
  }
  Client client() { return {io_, connections_.endpoint()}; }
  void settle() {
    io_.restart();
    while (io_.poll() > 0) {
    }
  }
  std::string names() const {
    std::string all;
    for (const CellPtr& each : host_.cells.all()) all += each->name() + " ";
    return all;
  }
  /// A client that has asked and closed its line.
  void visit() {
    Client visitor = client();
    visitor.send("E?");
    EXPECT_EQ(visitor.bytes(1), " ");
    visitor.half_close();
    EXPECT_EQ(visitor.rest(), "");
    settle();
  }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  ConnectionCells connections_;
};

TEST_F(ConnectionCellsTest, ACellAppearsWithTheFirstByteThatActs) {
  Client one = client();
  settle();
  EXPECT_EQ(names(), "");
  EXPECT_EQ(connections_.waiting(), 1U);
  one.send("GE");
  settle();
  EXPECT_EQ(names(), "") << "it may be a browser";
  one.send("?E?");
  EXPECT_EQ(one.bytes(1), " ");
  EXPECT_EQ(names(), "c1 ");
  EXPECT_EQ(connections_.waiting(), 0U);
  EXPECT_EQ(host_.cells.find("c1")->cell().lines().size(), 1U);
}

TEST_F(ConnectionCellsTest, TheLineBeginsWithTheBytesThatWereRead) {
  Client one = client();
  one.send("GE");
  settle();
  std::string asked = "?";
  constexpr std::size_t kInquiries = 5000;  // more than one read
  for (std::size_t i = 0; i < kInquiries; ++i) asked += "E?";
  one.send(asked);
  one.half_close();
  EXPECT_EQ(one.rest(), std::string(kInquiries + 1, ' '));
  settle();
  EXPECT_EQ(host_.cells.find("c1")->cell().counters().bytes_in, 2 + asked.size());
}

TEST_F(ConnectionCellsTest, AnUndecidedConnectionEvictsNoCell) {
  for (int i = 0; i < 3; ++i) visit();
  Client undecided = client();
  undecided.send("GE");
  settle();
  EXPECT_EQ(names(), "c1 c2 c3 ");
  undecided.half_close();
  EXPECT_EQ(undecided.rest(), "");
  EXPECT_EQ(names(), "c1 c2 c3 ");
  EXPECT_EQ(connections_.waiting(), 0U);
}

TEST_F(ConnectionCellsTest, OtherProtocolsGetNone) {
  for (const std::string opening : {"GET / HTTP/1.1\r\n", "\x16\x03\x01", "E+50 / HTTP/1.1\r\n"}) {
    Client other = client();
    other.send(opening);
    EXPECT_EQ(other.rest(), "");
  }
  EXPECT_EQ(connections_.turned_away(), 3U);
  Client silent = client();
  silent.send("GET");
  silent.half_close();
  EXPECT_EQ(silent.rest(), "");
  EXPECT_EQ(names(), "");
}

TEST_F(ConnectionCellsTest, TheLongestLingeringGoesFirst) {
  visit();
  visit();
  visit();
  EXPECT_EQ(names(), "c1 c2 c3 ");
  visit();
  EXPECT_EQ(names(), "c2 c3 c4 ");
  EXPECT_EQ(connections_.refused(), 0U);
}

TEST_F(ConnectionCellsTest, CellsWithALineStay) {
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<Client>(io_, connections_.endpoint()));
    clients.back()->send("E?");
    EXPECT_EQ(clients.back()->bytes(1), " ");
  }
  Client beyond = client();
  beyond.send("E?");
  EXPECT_EQ(beyond.rest(), "");
  EXPECT_EQ(connections_.refused(), 1U);
  EXPECT_EQ(names(), "c1 c2 c3 ");
}

TEST_F(ConnectionCellsTest, ConnectionsWithoutAByteCountToo) {
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < 4; ++i)
    silent.push_back(std::make_unique<Client>(io_, connections_.endpoint()));
  settle();
  Client beyond = client();
  EXPECT_EQ(beyond.rest(), "");
  EXPECT_EQ(connections_.refused(), 1U);
  EXPECT_EQ(connections_.waiting(), 4U);
  EXPECT_TRUE(connections_.is_full());
  silent.clear();
  settle();
  EXPECT_FALSE(connections_.is_full());
}

struct ShortLingerTest : ConnectionCellsTest {
  ShortLingerTest() : ConnectionCellsTest({4, 3, WallNs{1'000'000}}) {}
};

TEST_F(ShortLingerTest, ACellGoesSomeTimeAfterItsLine) {
  visit();
  const auto deadline = std::chrono::steady_clock::now() + 10s;
  while (!host_.cells.is_empty() && std::chrono::steady_clock::now() < deadline) {
    io_.restart();
    io_.run_one_for(20ms);
  }
  EXPECT_EQ(names(), "");
  visit();
  EXPECT_EQ(host_.cells.total(), 2U);
}

}  // namespace
}  // namespace xr3
