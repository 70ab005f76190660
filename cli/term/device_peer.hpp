// A serial device or a pseudo-terminal as the line of `xr3 term`.
#pragma once

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <optional>
#include <string>

#include "cli/term/peer.hpp"
#include "protocol/line/serial_settings.hpp"
#include "server/device/uucp_lock.hpp"

namespace xr3 {

class DevicePeer : public TermPeer {
 public:
  /// Opens the device, for this process alone, and sets it up. Throws ExitError.
  DevicePeer(asio::io_context& context, const std::string& path, const SerialSettings& settings);

  asio::awaitable<std::string_view> read() override;
  asio::awaitable<bool> write(std::string_view data) override;
  asio::awaitable<std::string> send_break() override;
  bool finish() override { return false; }

 private:
  std::optional<UucpLock> lock_;
  asio::posix::stream_descriptor device_;
  std::array<char, 8192> buffer_{};
};

}  // namespace xr3
