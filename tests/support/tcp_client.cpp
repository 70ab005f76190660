#include "tests/support/tcp_client.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <utility>

namespace xr3::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kDeadline = 10s;

}  // namespace

Client::Client(asio::io_context& io, const tcp::endpoint& server) : io_(io), socket_(io) {
  socket_.connect(server);
  socket_.non_blocking(true);
}

void Client::send(std::string_view bytes) { asio::write(socket_, asio::buffer(bytes)); }

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
