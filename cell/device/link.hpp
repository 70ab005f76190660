// The way to the physical controller while the simulator is disabled: whole commands go out, the
// lines by turns, one inquiry at a time, and each reply goes to the line that asked. No I/O: the
// server moves the bytes. Time is that of the cell.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/explain/cell_event.hpp"
#include "protocol/line/device_command.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/serial_settings.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

class DeviceLink {
 public:
  /// An inquiry that is not answered in this time after its last bit has left is forgotten.
  static constexpr Tick kPatience = 500;
  /// A line whose commands wait with this many bytes is not read further.
  static constexpr std::size_t kMaxWaiting = 256;

  /// Further commands wait while the outbox has this many bytes.
  static constexpr std::size_t kFullOutbox = 64;
  /// No more bytes than these are on their way: the system's buffer and the outbox. A device that
  /// takes bytes faster than its settings say, such as a pseudo-terminal, has received them before.
  static constexpr std::size_t kMaxHeld = 4096 + kFullOutbox;

  /// An inquiry of a line: nullopt for the line if it has closed meanwhile.
  struct PendingInquiry {
    std::optional<LineId> line;
    Command command;
    bool operator==(const PendingInquiry&) const = default;
  };

  /// `is_mirrored`: the simulation carries out the commands, too, and its replies are discarded.
  DeviceLink(std::string path, const SerialSettings& settings, bool is_mirrored = false);

  const std::string& path() const { return path_; }
  const SerialSettings& settings() const { return settings_; }
  bool is_mirrored() const { return is_mirrored_; }
  bool is_open() const { return is_open_; }
  /// In the current epoch: its first tick if the device was there before. nullopt while it is not.
  std::optional<Tick> opened_tick() const {
    return is_open_ ? std::optional(opened_) : std::nullopt;
  }
  std::uint64_t bytes_in() const { return bytes_in_; }
  std::uint64_t bytes_out() const { return bytes_out_; }

  /// The device is there, or has vanished. Everything that waits is dropped.
  void set_open(bool is_open, Tick now = 0);
  void begin_epoch(Tick first) { opened_ = first; }
  /// The bytes of the last command for the device; empty before the first.
  const std::string& last() const { return last_; }

  /// Whether commands of the lines go to the device: a command has disabled the simulator.
  bool is_engaged() const { return is_engaged_; }
  /// A command has switched the simulator. Commands that wait are dropped; an inquiry that has left
  /// still gets its reply.
  void engage(bool is_engaged);
  /// The number of calls of engage(): a change means that unfinished commands must be dropped.
  std::uint64_t switches() const { return switches_; }

  /// Whether add() may be called for this line. If not, take_woken() reports when it may.
  bool accepts(LineId line) const;
  /// Adds a command of a line, which is dropped if the device is absent. Precondition:
  /// for_device(command) has a value.
  void add(LineId line, const Command& command, Tick now);

  /// Handles a byte from the device: the inquiry that it answers, or nullopt if nobody asked.
  std::optional<PendingInquiry> receive(Tick now);
  /// The inquiry that waited too long for its answer, which is forgotten.
  std::optional<PendingInquiry> expire(Tick now);
  /// When expire() must be called; nullopt: no inquiry waits.
  std::optional<Tick> deadline() const;

  /// Drops everything that has not left, and stops all joints.
  void stop(Tick now);
  /// The number of calls of stop(): after a change, bytes that the system holds must be dropped,
  /// too.
  std::uint64_t stops() const { return stops_; }
  /// Replies to this line are discarded from now on. Its whole commands are still sent.
  void forget(LineId line);

  /// Lines for which add() may be called again.
  std::vector<LineId> take_woken() { return std::exchange(woken_, {}); }

  /// Bytes for the device. Valid until the next call.
  std::string_view outbox() const { return outbox_; }
  /// Removes the first `count` bytes of the outbox, which may get new ones. Precondition:
  /// count <= outbox().size().
  void sent(std::size_t count, Tick now);

  void write_state(StateWriter& out) const;

  bool operator==(const DeviceLink&) const = default;

 private:
  struct QueuedCommand {
    std::optional<LineId> line;
    Command command;
    DeviceCommand encoded;
    bool operator==(const QueuedCommand&) const = default;
  };
  /// The commands of one line.
  struct Queue {
    std::deque<QueuedCommand> commands;
    std::size_t bytes = 0;  ///< of all of them
    bool operator==(const Queue&) const = default;
  };

  void drop();
  void drop_waiting();
  QueuedCommand take_next();
  void send_next(Tick now);
  void send(std::string_view bytes, Tick now);

  std::string path_;
  SerialSettings settings_;
  bool is_mirrored_;
  bool is_open_ = false;
  Tick opened_ = 0;
  std::string last_;
  bool is_engaged_ = false;
  std::uint64_t switches_ = 0;
  std::uint64_t stops_ = 0;
  std::map<LineId, Queue> queues_;  ///< those that are not empty
  LineId last_served_ = 0;
  std::vector<LineId> woken_;
  std::optional<PendingInquiry> asked_;
  Tick asked_until_ = 0;  ///< then asked_ is forgotten
  std::string outbox_;
  Micros busy_until_us_ = 0;  ///< when the last bit of all bytes so far has left
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
};

}  // namespace xr3
