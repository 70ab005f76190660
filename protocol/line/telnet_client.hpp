// The client's end of a telnet connection with COM-PORT (RFC 2217): it asks for 8-bit transmission
// and for the serial port of a terminal server, sets that port up, and sends breaks. telnet.hpp is
// the server's end. Sans-I/O.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/line/serial_settings.hpp"
#include "protocol/line/telnet_codes.hpp"
#include "protocol/line/telnet_options.hpp"
#include "protocol/line/telnet_parser.hpp"

namespace xr3 {

class TelnetClient {
 public:
  /// `wanted`: the settings for the server's port.
  explicit TelnetClient(const SerialSettings& settings) : wanted_(settings) {}

  /// The bytes that open the negotiation.
  std::string opening();

  /// Handles a byte from the server. Returns data, or nullopt. Appends the answers for the server
  /// to `answers`.
  std::optional<std::uint8_t> feed(std::uint8_t byte, std::string& answers);

  /// Appends data in the encoding of telnet: FF is doubled.
  static void encode(std::string_view data, std::string& out) { append_escaped(out, data); }

  /// Whether the server has accepted COM-PORT.
  bool has_com_port() const;
  /// Whether the server has refused COM-PORT, or answered every setting.
  bool is_settled() const;
  /// Whether the server has asked to send no data for now.
  bool is_suspended() const { return is_suspended_; }
  /// The settings that the server has confirmed; until is_settled(), the wanted ones.
  SerialSettings settings() const;

  /// Appends the request to begin or to end a break. Precondition: has_com_port().
  void append_break(bool is_on, std::string& out) const;

  bool operator==(const TelnetClient&) const = default;

 private:
  void request_settings(std::string& out) const;
  void handle_answer();

  SerialSettings wanted_;
  SerialSettings confirmed_{kDefaultBaud, SerialFrame{}};
  std::uint32_t answered_ = 0;  ///< a bit for the code of each answered setting
  bool is_suspended_ = false;
  TelnetParser parser_;
  TelnetOptions options_;
};

}  // namespace xr3
