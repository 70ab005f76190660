// A virtual serial line: what stands between a transport and the controller. A chain of filters
// (guard against strangers, telnet), the endpoint with its parser, and an outbox. It knows no socket:
// TCP, a console or a test's memory are its transports.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/http_tls_detector.hpp"
#include "protocol/line/rhino_endpoint.hpp"
#include "protocol/line/telnet.hpp"

namespace xr3 {

class SerialLine {
 public:
  /// Above this the line takes no further byte until its transport has taken replies.
  static constexpr std::size_t kFullOutbox = 64 * 1024;

  SerialLine(Profile profile, LineKind kind, std::string peer, Tick opened)
      : endpoint_(profile), kind_(kind), peer_(std::move(peer)), opened_(opened) {}

  /// Takes bytes at the simulation's tick and returns how many: all, unless the outbox is full or the
  /// client turned out to be a stranger.
  std::size_t receive(std::string_view bytes, Simulation& simulation,
                      std::vector<Exchange>& exchanges);

  /// Puts reply bytes into the outbox, as the client's end must see them.
  void deliver(std::string_view replies);

  bool is_full() const { return outbox().size() >= kFullOutbox; }
  /// A browser, a TLS or a WebRTC client: to be closed; nothing that it sent has acted.
  bool is_not_a_robot_program() const { return is_not_a_robot_program_; }
  /// Bytes that the guard still holds back.
  std::size_t held_bytes() const { return detector_.held().size(); }
  /// The filter as it is before the next byte; a monitor's line has none.
  std::optional<TelnetFilter> telnet() const {
    return kind_ == LineKind::kMonitor ? std::nullopt : std::optional(telnet_);
  }
  LineKind kind() const { return telnet_.is_telnet() ? LineKind::kTelnet : kind_; }

  /// Bytes for the transport; whoever sends some removes them by sent().
  std::string_view outbox() const { return std::string_view(outbox_).substr(sent_); }
  void sent(std::size_t count);

  /// Forgets commands that have begun.
  void reset() { endpoint_.reset(); }

  /// What was made of the last bytes, and how much of it was not obeyed or surprising.
  const RawBytes& last() const { return last_; }
  std::uint64_t warnings() const { return warnings_; }
  void note(const RawBytes& last) { last_ = last; }
  void note_warning() { ++warnings_; }

  const std::string& peer() const { return peer_; }
  Tick opened_tick() const { return opened_; }
  std::uint64_t bytes_in() const { return bytes_in_; }
  std::uint64_t bytes_out() const { return bytes_out_; }
  /// Where the next byte of output will stand, the outbox counted.
  std::uint64_t output_end() const { return bytes_out_ + outbox().size(); }

 private:
  void act(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
           std::vector<Exchange>& exchanges);
  void act_on(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
              std::vector<Exchange>& exchanges);

  HttpTlsDetector detector_;
  TelnetFilter telnet_;
  RhinoEndpoint endpoint_;
  std::string outbox_;
  std::size_t sent_ = 0;  ///< bytes at the outbox's beginning that are out already
  LineKind kind_;
  std::string peer_;
  Tick opened_;
  std::uint64_t bytes_in_ = 0;  ///< as the transport delivered them, telnet and held bytes included
  std::uint64_t bytes_out_ = 0;  ///< as the transport took them
  std::uint64_t warnings_ = 0;
  RawBytes last_;
  bool is_not_a_robot_program_ = false;
};

}  // namespace xr3
