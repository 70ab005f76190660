#include "cli/term/device_peer.hpp"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <boost/asio/write.hpp>
#include <cerrno>
#include <cstring>

#include "server/device/serial_device.hpp"

namespace xr3 {
namespace {

/// Whether the device has modem lines, which a pseudo-terminal lacks.
bool has_modem_lines(int device) {
  int lines = 0;
  return ::ioctl(device, TIOCMGET, &lines) == 0;
}

}  // namespace

DevicePeer::DevicePeer(asio::io_context& context, const std::string& path,
                       const SerialSettings& settings)
    : device_(context) {
  try {
    lock_.emplace(path);
    device_.assign(open_serial_device(path, settings));
  } catch (const SerialDeviceError& error) {
    throw ExitError(error.is_in_use() ? ExitCode::kPortInUse : ExitCode::kBadInput, error.what());
  }
}

asio::awaitable<std::string_view> DevicePeer::read() {
  const auto [error, size] = co_await device_.async_read_some(asio::buffer(buffer_), kAwait);
  co_return error ? std::string_view{} : std::string_view(buffer_.data(), size);
}

asio::awaitable<bool> DevicePeer::write(std::string_view data) {
  const auto [error, size] =
      co_await asio::async_write(device_, asio::buffer(data.data(), data.size()), kAwait);
  co_return !error;
}

asio::awaitable<std::string> DevicePeer::send_break() {
  if (!has_modem_lines(device_.native_handle())) {
    co_return "not possible here: a pseudo-terminal has no break";
  }
  if (::tcsendbreak(device_.native_handle(), 0) != 0) {
    co_return "not possible here: " + std::string(std::strerror(errno));
  }
  co_return std::string{};
}

}  // namespace xr3
