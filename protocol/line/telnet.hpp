// A telnet filter in front of the parser (RFC 854, 855): commands never reach the controller, and
// options and the settings of the serial port (RFC 2217) are answered. DO TIMING-MARK is answered,
// too, because a telnet client that sent Ctrl-C discards all output until then. A raw client never
// receives an IAC. A copyable value without I/O.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/line/com_port.hpp"
#include "protocol/line/telnet_options.hpp"
#include "protocol/line/telnet_parser.hpp"

namespace xr3 {

/// The result of one byte from the client: data, a command about bytes in transit, or neither.
struct TelnetInput {
  std::optional<std::uint8_t> data;  ///< for the controller
  BufferControl control = BufferControl::kNone;
};

class TelnetFilter {
 public:
  /// Handles a byte from the client. Appends the answers of the telnet protocol to `answers`.
  TelnetInput feed(std::uint8_t byte, std::string& answers) {
    const TelnetItem item = parser_.feed(byte);
    if (item.kind == TelnetItem::ItemKind::kData) return {item.byte};
    return handle(item, answers);
  }

  /// Whether feed() would return this byte as data.
  bool is_data(std::uint8_t byte) const { return parser_.is_data(byte); }

  /// Whether the client speaks telnet: it has sent a complete option or an interrupt (IP).
  bool is_telnet() const { return is_telnet_; }

  /// Whether the option COM-PORT is on at either side.
  bool has_com_port() const;
  /// The settings of the serial port; nullopt without COM-PORT.
  std::optional<SerialSettings> settings() const;

  /// Appends reply bytes in the client's encoding: FF is doubled for telnet.
  void encode(std::string_view replies, std::string& out) const;

  /// Reports a parity error of the next byte, if the client has a serial port.
  void report_parity_error(std::string& out) const {
    if (has_com_port()) com_port_.append_parity_error(out);
  }

  bool operator==(const TelnetFilter&) const = default;
  void write_state(StateWriter& out) const { out.add(parser_, is_telnet_, options_, com_port_); }

 private:
  /// The rest of feed(): separate because almost every byte is data.
  TelnetInput handle(const TelnetItem& item, std::string& answers);
  BufferControl negotiate(const TelnetItem& item, std::string& answers);
  BufferControl end_subnegotiation(std::string& answers);

  TelnetParser parser_;
  bool is_telnet_ = false;
  TelnetOptions options_;
  ComPort com_port_;
};

}  // namespace xr3
