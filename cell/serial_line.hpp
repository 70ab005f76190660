// A virtual serial line between a transport and the controller: the detector of HTTP and TLS
// clients, the telnet filter, the endpoint with its parser, replies that the client has suspended,
// and an outbox. No sockets: the transport is TCP, a pseudo-terminal, a monitor session or a test.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/device_link.hpp"
#include "cell/reply_hold.hpp"
#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/http_tls_detector.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/rhino_endpoint.hpp"
#include "protocol/line/serial_settings.hpp"
#include "protocol/line/telnet.hpp"

namespace xr3 {

class SerialLine {
 public:
  /// With this many bytes in the outbox, the line accepts no byte until its transport has sent
  /// some.
  static constexpr std::size_t kFullOutbox = 64 * 1024;

  SerialLine(Profile profile, LineKind kind, std::string peer, Tick opened,
             Guard guard = Guard::kNormal)
      : guard_(guard), endpoint_(profile), kind_(kind), peer_(std::move(peer)), opened_(opened) {}

  /// Examines the bytes that have arrived first, and together; receive() takes them only if they
  /// may come from a robot program. A transport that is not a network need not call it.
  void examine(std::string_view first_chunk) {
    is_not_a_robot_program_ = is_refused(first_chunk, guard_);
  }

  /// Processes bytes at the simulation's tick. Returns the number of bytes taken: all, unless the
  /// outbox is full, so many replies are held that no byte of data is taken, or the client is
  /// detected not to be a robot program.
  std::size_t receive(std::string_view bytes, Simulation& simulation,
                      std::vector<Exchange>& exchanges);

  /// From now on, whole commands go to a device while the simulator is disabled. The link must
  /// outlive the line; `own` is the line's number.
  void connect(DeviceLink& link, LineId own) {
    device_ = &link;
    id_ = own;
  }
  /// Sends the device's reply to an inquiry of this line.
  void deliver(std::uint8_t reply, const Command& inquiry);

  /// No more bytes will be received: held replies go to the outbox, and no reply is held any more.
  void end_input();
  bool has_input_ended() const { return has_input_ended_; }

  /// The replies that the last receive(), deliver() or end_input() has added to the outbox without
  /// an exchange, by offset in the output.
  const std::vector<wire::Item>& released() const { return released_; }
  /// Replies that the client has suspended, in bytes. They are not in the outbox.
  std::size_t held_bytes() const { return hold_.size(); }

  bool is_full() const { return outbox().size() >= kFullOutbox; }
  /// Whether receive() would take a byte. Commands of telnet are taken while the hold is full, or
  /// the one that ends it would never be read.
  bool accepts(char next) const {
    return !is_full() && !waits_for_device() &&
           !(hold_.is_full() && telnet_.is_data(static_cast<std::uint8_t>(next)));
  }
  /// Whether the client was detected not to be a robot program, such as one of HTTP, TLS or STUN.
  /// The transport must close the line; no byte of the client has acted.
  bool is_not_a_robot_program() const { return is_not_a_robot_program_; }
  /// Whether the transport is a network: only there are HTTP and TLS detected and telnet filtered.
  bool is_network() const { return kind_ == LineKind::kTcp; }
  /// A copy of the telnet filter before the next byte; nullopt if there is none.
  std::optional<TelnetFilter> telnet() const {
    return is_network() ? std::optional(telnet_) : std::nullopt;
  }
  /// The settings of the serial port; nullopt if they are not known.
  std::optional<SerialSettings> settings() const {
    return telnet_.has_com_port() ? telnet_.settings() : settings_;
  }
  /// `is_cooked`: the client's terminal echoes or edits lines. Returns whether it does so for the
  /// first time.
  bool set_settings(const SerialSettings& settings, bool is_cooked) {
    settings_ = settings;
    const bool was_cooked = is_cooked_;
    is_cooked_ |= is_cooked;
    return is_cooked_ && !was_cooked;
  }
  LineKind kind() const;

  /// Bytes for the transport to send. Valid until the next receive() or sent().
  std::string_view outbox() const { return std::string_view(outbox_).substr(sent_); }
  /// Removes the first `count` bytes of the outbox. Precondition: count <= outbox().size().
  void sent(std::size_t count);

  /// Discards an incomplete command.
  void reset() { endpoint_.reset(); }

  /// The bytes of the last command or problem, and the number of problems and warnings.
  const RawBytes& last() const { return last_; }
  std::uint64_t warnings() const { return warnings_; }
  void note(const RawBytes& last) { last_ = last; }
  void note_warning() { ++warnings_; }

  const std::string& peer() const { return peer_; }
  Tick opened_tick() const { return opened_; }
  std::uint64_t bytes_in() const { return bytes_in_; }
  std::uint64_t bytes_out() const { return bytes_out_; }
  /// The offset of the next output byte, after all bytes of the outbox.
  std::uint64_t output_end() const { return bytes_out_ + outbox().size(); }

 private:
  void act(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
           std::vector<Exchange>& exchanges);
  void act_on(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
              std::vector<Exchange>& exchanges);
  bool waits_for_device() const {
    return device_ != nullptr && device_->is_engaged() && !device_->accepts(id_);
  }
  void drop_unfinished();
  void act_on_device(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
                     std::vector<Exchange>& exchanges);
  static void imitate(const Command& command, Exchange& exchange, Simulation& simulation);
  void control(ReplyControl replies);
  void release();
  void send(std::string_view replies);

  HttpTlsDetector detector_;
  Guard guard_;
  TelnetFilter telnet_;
  RhinoEndpoint endpoint_;
  DeviceLink* device_ = nullptr;  ///< none if null
  LineId id_ = 0;                 ///< for device_
  RhinoParser device_parser_{Profile::kMark3};
  std::uint64_t seen_switches_ = 0;  ///< of device_
  ReplyHold hold_;
  std::vector<wire::Item> released_;
  bool has_input_ended_ = false;
  std::string outbox_;
  std::size_t sent_ = 0;  ///< bytes at the start of the outbox that are already sent
  LineKind kind_;
  std::optional<SerialSettings> settings_;
  bool is_cooked_ = false;
  std::string peer_;
  Tick opened_;
  std::uint64_t bytes_in_ = 0;   ///< as received, including telnet commands and held bytes
  std::uint64_t bytes_out_ = 0;  ///< as sent
  std::uint64_t warnings_ = 0;
  RawBytes last_;
  bool is_not_a_robot_program_ = false;
};

}  // namespace xr3
