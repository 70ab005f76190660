// Accepting connections over real sockets: their options, their peers, and their sockets.
#include "server/net/listener.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <boost/system/system_error.hpp>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace xr3 {
namespace {

struct ListenerTest : testing::Test {
  ListenerTest() { EXPECT_FALSE(listener.listen({asio::ip::address_v4::loopback(), 0})); }
  ~ListenerTest() override {
    listener.close();
    settle();
  }

  void settle() {
    io.restart();
    while (io.poll() > 0) {
    }
  }
  tcp::socket client() {
    tcp::socket socket(io);
    socket.connect(listener.endpoint());
    return socket;
  }
  int option(int level, int name) const {
    int value = -1;
    socklen_t size = sizeof value;
    ::getsockopt(accepted.at(0).descriptor.get(), level, name, &value, &size);
    return value;
  }

  asio::io_context io{1};
  std::vector<NewConnection> accepted;
  Listener listener{
      io, "test", [this](NewConnection connection) { accepted.push_back(std::move(connection)); }};
};

TEST_F(ListenerTest, AConnectionDetectsDeadPeersWithin60s) {
  const tcp::socket peer = client();
  settle();
  EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPIDLE), 30);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPINTVL) * option(IPPROTO_TCP, TCP_KEEPCNT), 30);
}

TEST_F(ListenerTest, AConnectionSendsAtOnceAndBuffersLittle) {
  const tcp::socket peer = client();
  settle();
  EXPECT_EQ(option(IPPROTO_TCP, TCP_NODELAY), 1);
  EXPECT_EQ(option(SOL_SOCKET, SO_SNDBUF), 2 * 128 * 1024);
}

TEST_F(ListenerTest, AConnectionDoesNotBlockAndIsNotInherited) {
  const tcp::socket peer = client();
  settle();
  const int descriptor = accepted.at(0).descriptor.get();
  EXPECT_NE(::fcntl(descriptor, F_GETFL) & O_NONBLOCK, 0);
  EXPECT_NE(::fcntl(descriptor, F_GETFD) & FD_CLOEXEC, 0);
}

TEST_F(ListenerTest, HeldConnectionsWaitInTheKernel) {
  int waiting = 0;
  listener.hold([&] { ++waiting; });
  const tcp::socket peer = client();
  settle();
  listener.accept_pending();
  EXPECT_EQ(waiting, 1);
  EXPECT_TRUE(accepted.empty());
  listener.release();
  settle();
  EXPECT_EQ(accepted.size(), 1U);
}

TEST_F(ListenerTest, ThePeerIsKnown) {
  const tcp::socket peer = client();
  settle();
  EXPECT_EQ(accepted.at(0).peer, peer.local_endpoint());
  EXPECT_EQ(to_text(accepted.at(0).peer),
            "127.0.0.1:" + std::to_string(peer.local_endpoint().port()));
}

TEST_F(ListenerTest, ThePeerOfALostConnectionIsKnown) {
  tcp::socket peer = client();
  const tcp::endpoint endpoint = peer.local_endpoint();
  peer.set_option(tcp::socket::linger(true, 0));
  peer.close();  // with a reset, before the connection is accepted
  settle();
  EXPECT_EQ(accepted.at(0).peer, endpoint);
}

TEST_F(ListenerTest, TheEventLoopWatchesTheSocketOfAConnection) {
  tcp::socket peer = client();
  settle();
  tcp::socket socket = to_socket(io, std::move(accepted.at(0)));
  std::string received(8, ' ');
  socket.async_read_some(asio::buffer(received),
                         [&](ErrorCode, std::size_t count) { received.resize(count); });
  asio::write(peer, asio::buffer("E?", 2));
  settle();
  EXPECT_EQ(received, "E?");
}

TEST_F(ListenerTest, AConnectionThatTheEventLoopCannotWatchIsClosed) {
  const int unwatchable = ::open("/", O_PATH | O_CLOEXEC);
  NewConnection connection{Descriptor(unwatchable), {asio::ip::address_v4::loopback(), 1}};
  EXPECT_THROW(to_socket(io, std::move(connection)), boost::system::system_error);
  EXPECT_EQ(::fcntl(unwatchable, F_GETFD), -1);
}

TEST_F(ListenerTest, AConnectionThatCannotBeServedCountsAsAFailure) {
  Listener refusing(io, "test", [](const NewConnection&) {
    throw boost::system::system_error(asio::error::no_memory);
  });
  ASSERT_FALSE(refusing.listen({asio::ip::address_v4::loopback(), 0}));
  tcp::socket peer(io);
  peer.connect(refusing.endpoint());
  settle();
  EXPECT_EQ(refusing.failures(), 1);
  EXPECT_EQ(refusing.trouble(), "test cannot accept a connection: Cannot allocate memory");
  refusing.close();
  settle();
}

TEST_F(ListenerTest, AFailureIsOverWithTheNextConnection) {
  bool is_refusing = true;
  Listener second(io, "test", [&](const NewConnection&) {
    if (std::exchange(is_refusing, false))
      throw boost::system::system_error(asio::error::no_memory);
  });
  EXPECT_EQ(second.trouble(), "test is closed");
  ASSERT_FALSE(second.listen({asio::ip::address_v4::loopback(), 0}));
  EXPECT_EQ(second.trouble(), "");
  tcp::socket refused(io);
  refused.connect(second.endpoint());
  settle();
  EXPECT_NE(second.trouble(), "");
  tcp::socket served(io);
  served.connect(second.endpoint());
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!second.trouble().empty() && std::chrono::steady_clock::now() < deadline) {
    io.restart();
    io.run_one_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(second.trouble(), "");
  second.close();
  settle();
  EXPECT_EQ(second.trouble(), "test is closed");
}

TEST_F(ListenerTest, AConnectionOfIPv6HasAnAddressInBrackets) {
  Listener second(io, "test",
                  [this](NewConnection connection) { accepted.push_back(std::move(connection)); });
  ASSERT_FALSE(second.listen({asio::ip::address_v6::loopback(), 0}));
  tcp::socket peer(io);
  peer.connect(second.endpoint());
  settle();
  second.close();
  settle();
  EXPECT_EQ(to_text(accepted.at(0).peer), "[::1]:" + std::to_string(peer.local_endpoint().port()));
}

TEST_F(ListenerTest, AnAdoptedSocketGivesItsConnectionsTheOptions) {
  tcp::acceptor own(io, {asio::ip::address_v4::loopback(), 0});
  const tcp::endpoint endpoint = own.local_endpoint();
  ASSERT_FALSE(listener.adopt(own.release()));
  tcp::socket peer(io);
  peer.connect(endpoint);
  settle();
  EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(option(SOL_SOCKET, SO_SNDBUF), 2 * 128 * 1024);
}

}  // namespace
}  // namespace xr3
