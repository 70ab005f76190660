// The serial port that a telnet client sets up by the COM-PORT option (RFC 2217): the requests in
// its subnegotiations and their answers. The settings are stored and reported; they have no effect
// on the bytes, and break, DTR and RTS have none on the controller. Sans-I/O.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/line/serial_settings.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

/// A client's request about the bytes that are in transit in either direction.
enum class BufferControl : std::uint8_t {
  kNone,
  kSuspend,      ///< hold replies until kResume
  kResume,       ///< send the held replies
  kDropReplies,  ///< discard the replies that the client has not received yet
  kDropInput,    ///< discard the bytes that have not reached the controller yet
  kDropBoth,
};

class ComPort {
 public:
  /// The longest request that has a meaning: a code and a speed. The rest of a longer one need not
  /// be passed.
  static constexpr std::size_t kMaxRequest = 5;

  /// Handles a request: the code and its value, without the bytes around them. Appends the answer;
  /// there is none to an unknown request or one of a wrong length. A setting is answered with
  /// the value asked for, a question with the value in effect.
  BufferControl handle(std::span<const std::uint8_t> request, std::string& answers);

  /// Appends NOTIFY-MODEMSTATE: CTS, DSR and carrier are on, ring is off, and nothing has changed.
  static void append_modem_state(std::string& answers);

  /// Appends NOTIFY-LINESTATE with a parity error, unless the client has set a mask without it.
  void append_parity_error(std::string& answers) const;

  /// The client's settings; until it sets them, those of the Mark III controller.
  SerialSettings settings() const;

  bool operator==(const ComPort&) const = default;
  void write_state(StateWriter& out) const {
    out.add(text_of(settings()), line_state_mask_, controls_);
  }

 private:
  void set_baud(std::span<const std::uint8_t> value, std::string& answers);
  std::uint8_t set(std::uint8_t code, std::uint8_t value);
  std::uint8_t set_data_bits(std::uint8_t value);
  std::uint8_t set_control(std::uint8_t value);

  std::uint32_t baud_ = kDefaultBaud;
  SerialFrame frame_;  ///< without flow control
  std::uint8_t line_state_mask_ = 0xFF;
  /// The values in effect of SET-CONTROL: flow control out, break, DTR, RTS, flow control in.
  std::array<std::uint8_t, 5> controls_{1, 6, 8, 11, 14};
};

}  // namespace xr3
