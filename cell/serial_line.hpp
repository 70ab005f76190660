// A virtual serial line between a transport and the controller: the detector of HTTP and TLS
// clients, the telnet filter, the endpoint with its parser, replies that the client has suspended,
// and an outbox. With a line speed, bytes of data wait in front of the endpoint, and replies behind
// it, until their time has come. No sockets: the transport is TCP, a pseudo-terminal, a monitor
// session or a test.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/byte_run.hpp"
#include "cell/device_link.hpp"
#include "cell/line_faults.hpp"
#include "cell/line_listener.hpp"
#include "cell/line_pace.hpp"
#include "cell/reply_hold.hpp"
#include "core/simulation.hpp"
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

  SerialLine(Profile profile, LineKind kind, std::string peer, Tick opened,
             Guard guard = Guard::kNormal)
      : guard_(guard), endpoint_(profile), kind_(kind), peer_(std::move(peer)), opened_(opened) {}

  /// Examines the bytes that have arrived first, and together; receive() takes them only if they
  /// may come from a robot program. A transport that is not a network need not call it.
  void examine(std::string_view first_chunk) {
    is_not_a_robot_program_ = is_refused(first_chunk, guard_);
  }

  /// Processes bytes at the simulation's tick; with a line speed, bytes of data act later, by
  /// act_due(). Returns the number of bytes taken: all, unless the outbox is full, so many bytes
  /// wait or replies are held that no byte of data is taken, the client is detected not to be a
  /// robot program, or, with a line speed, bytes of data follow commands of telnet or the reverse.
  std::size_t receive(std::string_view bytes, Simulation& simulation,
                      std::vector<Exchange>& exchanges);

  /// From now on, whole commands go to a device while the simulator is disabled. The link must
  /// outlive the line; `own` is the line's number.
  void connect(DeviceLink& link, LineId own);
  /// From now on, the listener hears of the bytes of data. It must outlive the line; `own` is the
  /// line's number. Precondition: no device is connected.
  void listen(LineListener& listener, LineId own);
  /// From now on, bytes take their time. Preconditions: no byte has arrived, and no device is
  /// connected.
  void set_speed(const LineSpeed& speed);
  /// Whether bytes take their time. A line at the speed of its client begins so when that is known.
  bool is_paced() const { return pace_.has_value(); }
  /// When the next byte of a direction is due; nullopt: none is.
  std::optional<Micros> due(Direction direction) const {
    return pace_ ? pace_->due(direction) : std::nullopt;
  }
  /// From now on, faults of the machine act on the line's bytes. `own` is the line's number.
  void expose(LineId own, const State& state) { faults_.emplace(own, state); }
  bool has_fault_events() const { return faults_ && faults_->has_events(); }
  /// Removes and returns the events of faults on this line, in order. Precondition: there are some.
  Events take_fault_events() {
    assert(has_fault_events());
    return faults_->take_events();
  }
  /// Disconnects the line by a fault: what waits is lost.
  void cut();
  /// Whether a fault has disconnected the line: it takes no more bytes, and the transport must
  /// close it when its replies have left.
  bool is_cut() const { return faults_ && faults_->is_cut(); }
  /// Whether a fault holds replies back.
  bool holds_replies() const { return faults_ && !faults_->is_empty(); }
  /// When the next reply, or byte of one, is due; nullopt: none is, or that is not known.
  std::optional<Micros> next_reply(const State& state) const;
  /// Whether a reply that a fault has held back may leave now.
  bool is_reply_released(const State& state) const;
  /// These replies leave, at the speed of the line.
  void release_replies(const State& state, Micros now);
  /// Forgets the replies that a fault holds back.
  void discard_held_back() {
    if (faults_) faults_->discard();
  }
  /// The byte that is due acts on the simulation, at its tick. Precondition: due(kIn) has a value.
  void act_due(Micros now, Simulation& simulation, std::vector<Exchange>& exchanges);
  /// The byte of a reply that is due goes to the outbox. Precondition: due(kOut) has a value.
  void send_due(Micros now);
  /// The bytes that act_due() has handled, for the next record of the line.
  ByteRun& acted() { return acted_; }
  /// The bytes that send_due() has sent, for the next record of the line.
  ByteRun& departed() { return departed_; }
  /// Time has jumped: bytes under way start again.
  void restart(Micros now) {
    if (pace_) pace_->restart(now);
    if (faults_) faults_->restart(first_tick_after(now));
  }
  /// The offset of the byte that acts next. Precondition: due(kIn) has a value.
  std::uint64_t next_offset() const { return pace_->next_input().offset; }
  /// Whether the next byte is data, not part of a telnet command.
  bool is_data(char next) const {
    return !is_network() || telnet_.is_data(static_cast<std::uint8_t>(next));
  }
  /// Bytes of data that have not acted.
  std::size_t input_under_way() const { return pace_ ? pace_->input_bytes() : 0; }
  /// No byte is under way in either direction.
  bool is_drained() const { return (!pace_ || pace_->is_empty()) && !holds_replies(); }
  /// The settings that give bytes their time; nullopt: they take none.
  std::optional<SerialSettings> speed() const;

  /// Sends the device's reply to an inquiry of this line.
  void deliver(std::uint8_t reply, const Command& inquiry);

  /// No more bytes will be received: held replies go to the outbox, at the speed of the line, and
  /// no reply is held any more.
  void end_input(Micros now);
  bool has_input_ended() const { return has_input_ended_; }

  /// The replies that the last receive(), send_due(), deliver() or end_input() has added to the
  /// outbox without an exchange, by offset in the output.
  const std::vector<wire::Item>& released() const { return released_; }
  /// The memory of replies that the client has suspended, and of bytes under way. They are not in
  /// the outbox.
  std::size_t held_bytes() const;

  bool is_full() const { return outbox().size() >= kFullOutbox; }
  /// Whether receive() would take a byte. Commands of telnet are taken while the hold is full, or
  /// the one that ends it would never be read.
  bool accepts(char next) const {
    return !is_full() && !waits_for_device() && !is_cut() && (can_take_data() || !is_data(next));
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
  bool set_settings(const SerialSettings& settings, bool is_cooked);
  LineKind kind() const;

  /// Bytes for the transport to send. Valid until the next receive() or sent().
  std::string_view outbox() const { return {outbox_.data() + sent_, outbox_.size() - sent_}; }
  /// Removes the first `count` bytes of the outbox. Precondition: count <= outbox().size().
  void sent(std::size_t count, Micros now);

  /// Discards an incomplete command.
  void reset() { endpoint_.reset(); }

  /// The bytes of the last command or problem, and the number of problems and warnings.
  const RawBytes& last() const { return last_; }
  std::uint64_t warnings() const { return warnings_; }
  void note(const RawBytes& last) { last_ = last; }
  void note_warning() { ++warnings_; }

  const std::string& peer() const { return peer_; }
  /// In the current epoch: its first tick if the line is older.
  Tick opened_tick() const { return opened_; }
  void begin_epoch(Tick first) { opened_ = first; }
  std::uint64_t bytes_in() const { return bytes_in_; }
  /// Without the bytes that wait for the detector or for their time.
  std::uint64_t bytes_acted() const {
    return bytes_in_ - detector_.held().size() - input_under_way();
  }
  std::uint64_t bytes_out() const { return bytes_out_; }
  /// The offset of the next output byte, after all bytes of the outbox.
  std::uint64_t output_end() const { return bytes_out_ + outbox().size(); }

  /// What the line's next bytes depend on; how much of the output the transport has sent does not
  /// belong to it.
  void write_state(StateWriter& out) const;

 private:
  /// The machine and the record that received bytes act on.
  struct Effects {
    Simulation& simulation;
    std::vector<Exchange>& exchanges;
    Micros now;
  };

  bool can_take_data() const {
    return !hold_.is_full() && (!pace_ || pace_->accepts_input()) &&
           (!faults_ || !faults_->is_full());
  }
  void receive_byte(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void filter(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void take_data(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void act_on(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void act_on_faulty(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void interpret(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  void execute(const std::vector<Parsed>& items, const Effects& effects);
  bool announce(const Parsed& item);
  void answer(std::string& replies, Exchange& exchange, const Effects& effects);
  bool leaves_now(std::string& reply, const Exchange& exchange, const Effects& effects);
  void leave(const DelayedReply& reply, Micros now);
  void update_pace();
  void update_input_halt(Micros now);
  bool waits_for_device() const {
    return device_ != nullptr && device_->is_engaged() && !device_->accepts(id_);
  }
  void drop_unfinished();
  void act_on_device(std::uint8_t byte, std::uint64_t offset, const Effects& effects);
  static void imitate(const Command& command, Exchange& exchange, Simulation& simulation);
  void control(BufferControl control, Micros now);
  void resume(Micros now);
  void drop_replies(Micros now);
  void drop_input();
  void release();
  void send(std::string_view replies);

  HttpTlsDetector detector_;
  Guard guard_;
  TelnetFilter telnet_;
  RhinoEndpoint endpoint_;
  DeviceLink* device_ = nullptr;  ///< none if null
  LineId id_ = 0;                 ///< for device_ and listener_
  RhinoParser device_parser_{Profile::kMark3};
  std::uint64_t seen_switches_ = 0;   ///< of device_
  LineListener* listener_ = nullptr;  ///< none if null
  std::optional<LineFaults> faults_;  ///< none: faults do not concern the line
  ReplyHold hold_;                    ///< without a pace: that holds the replies itself
  std::optional<LineSpeed> speed_;    ///< nullopt: bytes take no time
  std::optional<LinePace> pace_;      ///< nullopt while the speed is not known
  ByteRun acted_;
  ByteRun departed_;
  std::uint64_t reply_from_ = 0;  ///< of the reply that is leaving, in the output
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
