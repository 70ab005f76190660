// A virtual serial line as stages of values. In: the detector of HTTP and TLS clients, the telnet
// filter, bytes at the speed of a serial port, faults, the parser. Out: replies that faults delay,
// that the client has suspended, or that are under way at the speed of the port, then telnet and
// the outbox. The line passes nothing on by itself: cell/receive.hpp and cell/reply.hpp carry the
// bytes from stage to stage. No sockets: the transport is TCP, a pseudo-terminal, a monitor session
// or a test.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/line/byte_run.hpp"
#include "cell/line/faults.hpp"
#include "cell/line/outbox.hpp"
#include "cell/line/pace.hpp"
#include "cell/line/reply_hold.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/http_tls_detector.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/line_speed.hpp"
#include "protocol/line/rhino_endpoint.hpp"
#include "protocol/line/serial_settings.hpp"
#include "protocol/line/state_writer.hpp"
#include "protocol/line/telnet.hpp"

namespace xr3 {

class SerialLine {
 public:
  /// With this many bytes in the outbox, the line accepts no byte until its transport has sent
  /// some.
  static constexpr std::size_t kFullOutbox = 64 * 1024;

  SerialLine(LineId id, Profile profile, LineKind kind, std::string peer, Tick opened,
             Guard guard = Guard::kNormal)
      : id_(id),
        guard_(guard),
        endpoint_(profile),
        kind_(kind),
        peer_(std::move(peer)),
        opened_(opened) {}

  LineId id() const { return id_; }

  // --- In, from the transport to the parser.

  /// Examines the bytes that have arrived first, and together; none is accepted unless they may
  /// come from a robot program. A transport that is not a network need not call it.
  void examine(std::string_view first_chunk) {
    is_not_a_robot_program_ = is_refused(first_chunk, guard_);
  }
  /// Whether the line takes a byte now, as far as it knows. Commands of telnet are taken while the
  /// hold is full, or the one that ends it would never be read.
  bool accepts(char next) const {
    return !is_full() && !is_cut() && (can_take_data() || !is_data(next));
  }
  /// Whether the next byte is data, not part of a telnet command.
  bool is_data(char next) const {
    return !is_network() || telnet_.is_data(static_cast<std::uint8_t>(next));
  }
  /// Counts a byte of the transport, and returns the bytes that have passed the detector: this one
  /// is the last of them. None while they may begin a request of HTTP or TLS.
  std::string detect(std::uint8_t byte);
  /// Handles a byte that has passed the detector. Answers of telnet go to the outbox; the caller
  /// must pass data on and obey the control. Precondition: is_network().
  TelnetInput filter(std::uint8_t byte);
  /// Whether the byte of data is under way now, and acts when due(kIn) says.
  bool delays(const ReceivedByte& byte, Micros now);
  /// Removes the byte that is due, and notes it in acted(). Precondition: due(kIn) has a value.
  ReceivedByte take_due();
  /// The items that a byte completes; valid until the next call.
  const std::vector<Parsed>& parse(const ReceivedByte& in, bool enabled) {
    return endpoint_.parse(in.byte, in.offset, enabled);
  }
  const RhinoEndpoint& endpoint() const { return endpoint_; }
  /// Discards an incomplete command.
  void reset() { endpoint_.reset(); }
  /// The parser of commands for a physical controller; see cell/device.hpp.
  RhinoParser& device_parser() { return device_parser_; }
  /// Discards unfinished commands if the simulator was switched since the last call. `switches`:
  /// how often it was switched in all.
  void drop_unfinished(std::uint64_t switches);

  /// The faults that act on the line; nullptr: none do.
  LineFaults* faults() { return faults_ ? &*faults_ : nullptr; }
  const LineFaults* faults() const { return faults_ ? &*faults_ : nullptr; }
  /// From now on, faults of the machine act on the line's bytes.
  void expose(const State& state) { faults_.emplace(id_, state); }
  /// Disconnects the line by a fault: what waits is lost. No effect if faults do not act on it.
  void cut();
  /// Whether a fault has disconnected the line: it takes no more bytes, and the transport must
  /// close it when its replies have left.
  bool is_cut() const { return faults_ && faults_->is_cut(); }

  // --- Out, from the reply to the outbox.

  /// Whether the line keeps a reply for later: because it is suspended, or takes time.
  bool keeps(std::string_view reply, const wire::Meaning& meaning, Micros now);
  /// Puts a reply into the outbox, as telnet encodes it. Returns its place and meaning.
  wire::Item send(std::string_view reply, const wire::Meaning& meaning);
  /// The byte of a reply that is due goes to the outbox and to departed(). Returns the place of the
  /// reply with its last byte. Precondition: due(kOut) has a value. `left` is that byte.
  std::optional<wire::Item> send_due(char& left);
  void report_parity_error() { telnet_.report_parity_error(outbox_.end_bytes()); }

  /// The client suspends its replies.
  void suspend(Micros now);
  /// Replies are no longer suspended. Returns those that the caller must send.
  HeldReplies resume(Micros now);
  void drop_replies(Micros now);
  void drop_input() {
    if (pace_) pace_->discard_input();
  }
  /// No more bytes will be received. The caller resumes the line.
  void end_input() { has_input_ended_ = true; }
  bool has_input_ended() const { return has_input_ended_; }

  /// When the next reply, or byte of one, is due; nullopt: none is, or that is not known.
  std::optional<Micros> next_reply(const State& state) const;
  /// Whether a fault holds replies back.
  bool holds_replies() const { return faults_ && !faults_->is_empty(); }

  /// Bytes for the transport to send. Valid until the line changes.
  std::string_view outbox() const { return outbox_.bytes(); }
  /// Removes the first `count` bytes of the outbox. Precondition: count <= outbox().size().
  void sent(std::size_t count, Micros now);
  bool is_full() const { return outbox().size() >= kFullOutbox; }

  // --- The speed of the port.

  /// From now on, bytes take their time. Precondition: no byte has arrived.
  void set_speed(const LineSpeed& speed);
  /// The settings that give bytes their time; nullopt: they take none.
  std::optional<SerialSettings> speed() const;
  /// Whether bytes take their time. A line at the speed of its client begins so when that is known.
  bool is_paced() const { return pace_.has_value(); }
  /// When the next byte of a direction is due; nullopt: none is.
  std::optional<Micros> due(Direction direction) const {
    return pace_ ? pace_->due(direction) : std::nullopt;
  }
  /// The offset of the byte that acts next. Precondition: due(kIn) has a value.
  std::uint64_t next_offset() const { return pace_->next_input().offset; }
  /// Bytes of data that have not acted.
  std::size_t input_under_way() const { return pace_ ? pace_->input_bytes() : 0; }
  /// While the client does not read its replies, its bytes do not act.
  void update_input_halt(Micros now) {
    if (pace_) pace_->halt(Direction::kIn, is_full() || pace_->are_replies_full(), now);
  }
  /// Time has jumped: bytes under way start again.
  void restart(Micros now);
  /// No byte is under way in either direction.
  bool is_drained() const { return (!pace_ || pace_->is_empty()) && !holds_replies(); }
  /// The bytes that take_due() and send_due() have passed on, for the next record of the line.
  ByteRun& acted() { return acted_; }
  ByteRun& departed() { return departed_; }

  // --- The client.

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
  bool set_settings(const SerialSettings& settings, bool is_cooked);
  LineKind kind() const;
  const std::string& peer() const { return peer_; }
  /// In the current epoch: its first tick if the line is older.
  Tick opened_tick() const { return opened_; }
  void begin_epoch(Tick first) { opened_ = first; }

  /// The bytes of the last command or problem, and the number of problems and warnings.
  const RawBytes& last() const { return last_; }
  std::uint64_t warnings() const { return warnings_; }
  void note(const RawBytes& last) { last_ = last; }
  void note_warning() { ++warnings_; }

  std::uint64_t bytes_in() const { return bytes_in_; }
  /// Without the bytes that wait for the detector or for their time.
  std::uint64_t bytes_acted() const {
    return bytes_in_ - detector_.held().size() - input_under_way();
  }
  std::uint64_t bytes_out() const { return outbox_.begin(); }
  /// The offset of the next output byte, after all bytes of the outbox.
  std::uint64_t output_end() const { return outbox_.end(); }
  /// The memory of replies that the client has suspended, and of bytes under way. They are not in
  /// the outbox.
  std::size_t held_bytes() const;

  /// What the line's next bytes depend on; how much of the output the transport has sent does not
  /// belong to it.
  void write_state(StateWriter& out) const;

  bool operator==(const SerialLine&) const = default;

 private:
  bool can_take_data() const {
    return !hold_.is_full() && (!pace_ || pace_->accepts_input()) &&
           (!faults_ || !faults_->is_full());
  }
  void update_pace();

  LineId id_;
  HttpTlsDetector detector_;
  Guard guard_;
  bool is_not_a_robot_program_ = false;
  TelnetFilter telnet_;
  std::optional<LineSpeed> speed_;    ///< nullopt: bytes take no time
  std::optional<LinePace> pace_;      ///< nullopt while the speed is not known
  std::optional<LineFaults> faults_;  ///< none: faults do not concern the line
  RhinoEndpoint endpoint_;
  RhinoParser device_parser_{Profile::kMark3};
  std::uint64_t seen_switches_ = 0;  ///< of the device
  ReplyHold hold_;                   ///< without a pace: that holds the replies itself
  Outbox outbox_;
  std::uint64_t reply_from_ = 0;  ///< of the reply that is leaving, in the output
  bool has_input_ended_ = false;

  ByteRun acted_;
  ByteRun departed_;
  LineKind kind_;
  std::optional<SerialSettings> settings_;
  bool is_cooked_ = false;
  std::string peer_;
  Tick opened_;
  std::uint64_t bytes_in_ = 0;  ///< as received, including telnet commands and held bytes
  std::uint64_t warnings_ = 0;
  RawBytes last_;
};

}  // namespace xr3
