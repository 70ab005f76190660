#include "tests/support/tcp_client.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <utility>

namespace xr3::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kDeadline = 10s;
constexpr int kNarrowBytes = 4096;
constexpr int kNarrowSegment = 536;

}  // namespace

Client::Client(asio::io_context& io, const tcp::endpoint& server) : Client(io) { connect(server); }

Client Client::narrow(asio::io_context& io, const tcp::endpoint& server) {
  using SegmentBytes = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_MAXSEG>;
  Client client(io);
  client.socket_.open(server.protocol());
  client.socket_.set_option(tcp::socket::receive_buffer_size(kNarrowBytes));
  client.socket_.set_option(tcp::socket::send_buffer_size(kNarrowBytes));
  client.socket_.set_option(SegmentBytes(kNarrowSegment));
  client.connect(server);
  return client;
}

void Client::connect(const tcp::endpoint& server) {
  socket_.connect(server);
  socket_.non_blocking(true);
}

void Client::send(std::string_view bytes) { asio::write(socket_, asio::buffer(bytes)); }

std::size_t Client::send_some(std::string_view bytes) {
  ErrorCode blocked;
  return socket_.write_some(asio::buffer(bytes), blocked);
}

std::string Client::bytes(std::size_t count) {
  while (received_.size() < count && read()) {
  }
  const std::string bytes = received_.substr(0, count);
  received_.erase(0, bytes.size());
  return bytes;
}

std::string Client::line() {
  while (received_.find('\n') == std::string::npos && read()) {
  }
  const std::string line = received_.substr(0, received_.find('\n'));
  received_.erase(0, line.size() + 1);
  return line;
}

std::string Client::rest() {
  while (read()) {
  }
  return std::exchange(received_, {});
}

bool Client::read() {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  while (std::chrono::steady_clock::now() < deadline) {
    char bytes[4096];
    ErrorCode error;
    const std::size_t count = socket_.read_some(asio::buffer(bytes), error);
    received_.append(bytes, count);
    if (count > 0) return true;
    if (error != asio::error::would_block) return false;
    io_.run_one_for(20ms);
  }
  return false;
}

}  // namespace xr3::test
