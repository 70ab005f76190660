// A telnet filter in front of the parser (RFC 854, 855, 860). IAC sequences never reach the
// controller, every option is refused, and DO TIMING-MARK is answered, because a telnet client that
// sent Ctrl-C discards all output until then. A raw client never receives an IAC. A copyable value
// without I/O.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace xr3 {

class TelnetFilter {
 public:
  /// A subnegotiation longer than this is abandoned.
  static constexpr int kMaxSubnegotiationBytes = 512;

  /// Handles a byte from the client. Returns the data byte that it completes, if any. Appends the
  /// answers of the telnet protocol to `answers`.
  std::optional<std::uint8_t> feed(std::uint8_t byte, std::string& answers);

  /// The client speaks telnet: it has sent a complete option or an interrupt (IP).
  bool is_telnet() const { return is_telnet_; }

  /// Appends reply bytes in the client's encoding: FF is doubled for telnet.
  void encode(std::string_view replies, std::string& out) const;

  bool operator==(const TelnetFilter&) const = default;

 private:
  enum class Mode : std::uint8_t {
    kData,
    kCommand,
    kOption,
    kSubnegotiation,
    kSubnegotiationCommand
  };

  std::optional<std::uint8_t> feed_command(std::uint8_t byte);
  void feed_option(std::uint8_t option, std::string& answers);
  void feed_subnegotiation(std::uint8_t byte);

  Mode mode_ = Mode::kData;
  std::uint8_t verb_ = 0;  ///< WILL, WONT, DO or DONT before an option
  bool is_telnet_ = false;
  int length_ = 0;  ///< of the subnegotiation so far
};

}  // namespace xr3
