#include "server/device/port.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "cell/failure.hpp"
#include "server/device/serial_device.hpp"
#include "server/files/interrupted.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

constexpr const char* kDeviceName = "the device";

}  // namespace

DevicePort::DevicePort(asio::io_context& io, Cell& cell, std::string path,
                       const SerialSettings& settings, bool is_mirrored,
                       std::function<void()> on_input)
    : cell_(cell),
      path_(std::move(path)),
      settings_(settings),
      on_input_(std::move(on_input)),
      port_(io),
      reopen_(io),
      deadline_(io) {
  cell_.connect_device(path_, settings_, is_mirrored);
}

/// Throws SerialDeviceError; the port is closed then.
void DevicePort::open_port() {
  lock_.emplace(path_);
  port_.assign(open_serial_device(path_, settings_));
  discard_all(port_.native_handle());
  cell_.apply(DeviceOpened{}, wall_now());
}

void DevicePort::open() {
  open_port();
  spawn_loop(port_.get_executor(), kDeviceName, run());
}

void DevicePort::close() {
  is_closing_ = true;
  ErrorCode ignored;
  port_.close(ignored);
  reopen_.cancel();
  deadline_.cancel();
}

asio::awaitable<void> DevicePort::run() {
  while (!is_closing_) {
    if (port_.is_open()) {
      co_await read();
    } else {
      co_await wait_to_reopen();
    }
  }
}

asio::awaitable<void> DevicePort::read() {
  std::array<char, 256> bytes{};
  const auto [error, count] = co_await port_.async_read_some(asio::buffer(bytes), kAwait);
  if (is_closing_) co_return;
  if (error) {
    if (port_.is_open()) lose(error.message());
    co_return;
  }
  fatal_if_throws(kDeviceName, [&, this] {
    cell_.apply(DeviceIn{{bytes.data(), count}}, wall_now());
    on_input_();
  });
}

asio::awaitable<void> DevicePort::wait_to_reopen() {
  reopen_.expires_after(kReopenEvery);
  co_await reopen_.async_wait(kAwait);
  if (is_closing_) co_return;
  try {
    open_port();
  } catch (const SerialDeviceError&) {
    lock_.reset();
    co_return;  // not yet
  }
  on_input_();
}

void DevicePort::lose(const std::string& why) {
  ErrorCode ignored;
  port_.close(ignored);
  lock_.reset();
  cell_.apply(DeviceLost{why}, wall_now());
  on_input_();
}

// Writes pending bytes and sets the deadline. Losing the port meanwhile calls this again, without
// effect.
void DevicePort::pump() {
  if (is_closing_ || std::exchange(is_pumping_, true)) return;
  write();
  await_deadline();
  is_pumping_ = false;
}

void DevicePort::write() {
  const DeviceLink& link = *cell_.device();
  if (!port_.is_open()) return;
  const bool is_stopped = std::exchange(stops_, link.stops()) != link.stops();
  if (is_stopped) discard_output(port_.native_handle());
  while (!link.outbox().empty()) {
    const auto count = retry_interrupted(
        [&] { return ::write(port_.native_handle(), link.outbox().data(), link.outbox().size()); });
    if (count < 0 && errno == EAGAIN) return await_room();
    if (count < 0) return lose(std::strerror(errno));
    cell_.apply(DeviceOut{static_cast<std::size_t>(count)}, wall_now());
  }
}

void DevicePort::await_room() {
  if (std::exchange(waits_for_room_, true)) return;
  port_.async_wait(asio::posix::stream_descriptor::wait_write, [this](ErrorCode error) {
    waits_for_room_ = false;
    if (!error) fatal_if_throws(kDeviceName, [this] { on_input_(); });
  });
}

// Waits for the deadline of an inquiry. If the device does not answer in time, advancing the cell's
// time discards the inquiry, and the next one is sent.
void DevicePort::await_deadline() {
  const auto due = cell_.device()->deadline();
  if (!due) return;
  const Tick left = std::max<Tick>(*due - cell_.state().tick, 0);
  run_after(deadline_, std::chrono::milliseconds(left + 1), [this] {
    if (is_closing_) return;
    fatal_if_throws(kDeviceName, [this] {
      cell_.catch_up(wall_now());
      on_input_();
    });
  });
}

}  // namespace xr3
