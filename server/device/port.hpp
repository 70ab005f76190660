// Moves the bytes between the cell's device link and the serial port of a physical controller, and
// opens the port again when it returns.
//
// The flow through the folder: with --serial, open() locks the device (uucp_lock.hpp), opens it raw
// and for this process alone (serial_device.hpp), and starts a coroutine. The cell decides which
// bytes go to the controller: commands of the lines while the simulator is disabled, in the form of
// protocol/line/device_command.hpp. After each input of the cell the server calls pump(), which
// writes the bytes that the link has ready. The coroutine reads the replies and applies them to the
// cell as an input, which routes them to the line that asked. A timer at the link's deadline lets
// the cell give up an inquiry that the device does not answer. When the port is lost, such as a
// cable that was pulled out, the cell is told why, and opening is tried every half second until the
// device is back. The simulation and its lines continue meanwhile.
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
  /// Interval for opening a port that has vanished.
  static constexpr std::chrono::milliseconds kReopenEvery{500};

  /// Connects the cell, which must outlive the port, with a device. `on_input` is called after each
  /// input; it calls pump().
  DevicePort(asio::io_context& io, Cell& cell, std::string path, const SerialSettings& settings,
             bool is_mirrored, std::function<void()> on_input);
  DevicePort(const DevicePort&) = delete;
  DevicePort& operator=(const DevicePort&) = delete;

  /// Opens the device and starts serving it. Throws SerialDeviceError.
  void open();
  /// Writes pending bytes. Call after each input of the cell.
  void pump();
  /// Stops serving. Nothing is sent.
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
  std::function<void()> on_input_;
  std::optional<UucpLock> lock_;
  asio::posix::stream_descriptor port_;
  asio::steady_timer reopen_;
  asio::steady_timer deadline_;
  std::uint64_t stops_ = 0;  ///< the link's number of stops at the last write
  bool waits_for_room_ = false;
  bool is_pumping_ = false;
  bool is_closing_ = false;
};

}  // namespace xr3
