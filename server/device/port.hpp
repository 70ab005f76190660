// Moves the bytes between the cell's device link and the serial port of a physical controller, and
// opens the port again when it returns.
#pragma once

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <functional>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "server/device/uucp_lock.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class DevicePort {
 public:
  /// A port that has vanished is tried again this often.
  static constexpr std::chrono::milliseconds kReopenEvery{500};

  /// Connects the cell, which must outlive the port, with a device. `acted` is called after each
  /// input; it calls pump().
  DevicePort(asio::io_context& io, Cell& cell, std::string path, const SerialSettings& settings,
             bool is_mirrored, std::function<void()> acted);
  DevicePort(const DevicePort&) = delete;
  DevicePort& operator=(const DevicePort&) = delete;

  /// Opens the device and serves it from now on. Throws SerialDeviceError.
  void open();
  /// Writes what is due. To be called after each input of the cell.
  void pump();
  /// Serves no longer. Nothing is sent.
  void close();

 private:
  asio::awaitable<void> run();
  asio::awaitable<void> read();
  asio::awaitable<void> wait_to_reopen();
  void open_port();
  void write();
  void await_room();
  void lose(const std::string& why);
  void await_deadline();

  Cell& cell_;
  std::string path_;
  SerialSettings settings_;
  std::function<void()> acted_;
  std::optional<UucpLock> lock_;
  asio::posix::stream_descriptor port_;
  asio::steady_timer reopen_;
  asio::steady_timer deadline_;
  std::uint64_t stops_ = 0;  ///< of the link, when it was last written
  bool waits_for_room_ = false;
  bool is_pumping_ = false;
  bool is_closing_ = false;
};

}  // namespace xr3
