// The negotiation of telnet options by the method of RFC 1143: each option is on or off at each
// side, and only a change is answered, so that no exchange loops. We never ask first, so no side is
// ever between on and off. Sans-I/O.
#pragma once

#include <cstdint>
#include <string>

namespace xr3 {

class TelnetOptions {
 public:
  enum class Side : std::uint8_t {
    kClient,  ///< negotiated by WILL and WONT
    kServer,  ///< negotiated by DO and DONT
  };

  /// Handles WILL, WONT, DO or DONT from the client and appends the answer, if there is one.
  /// BINARY, SUPPRESS-GO-AHEAD and COM-PORT are accepted at either side; DO TIMING-MARK is always
  /// answered by WILL (RFC 860); everything else is refused.
  void negotiate(std::uint8_t verb, std::uint8_t option, std::string& answers);

  bool is_on(Side side, std::uint8_t option) const;

  bool operator==(const TelnetOptions&) const = default;

 private:
  std::uint8_t& states(Side side) { return side == Side::kClient ? client_ : server_; }
  std::uint8_t states(Side side) const { return side == Side::kClient ? client_ : server_; }

  // A bit for each accepted option.
  std::uint8_t client_ = 0;
  std::uint8_t server_ = 0;
};

}  // namespace xr3
