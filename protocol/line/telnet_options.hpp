// The negotiation of telnet options by the method of RFC 1143: each option is on or off at each
// side, and only a change is answered, so that no exchange loops. For both ends of a connection:
// the server never asks first, a client asks for options and never asks to end them. Sans-I/O.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/line/state_writer.hpp"

namespace xr3 {

class TelnetOptions {
 public:
  enum class Side : std::uint8_t {
    kPeer,  ///< negotiated by WILL and WONT from the peer
    kOwn,   ///< negotiated by DO and DONT from the peer
  };

  /// Appends the request to switch an option on; the peer's consent is then not answered.
  /// Precondition: an option that is accepted, and is off.
  void ask(Side side, std::uint8_t option, std::string& requests);

  /// Handles WILL, WONT, DO or DONT from the peer and appends the answer, if there is one.
  /// BINARY, SUPPRESS-GO-AHEAD and COM-PORT are accepted at either side; DO TIMING-MARK is always
  /// answered by WILL (RFC 860); everything else is refused.
  void negotiate(std::uint8_t verb, std::uint8_t option, std::string& answers);

  bool is_on(Side side, std::uint8_t option) const;
  /// Whether ask() has not been answered yet.
  bool is_asked(Side side, std::uint8_t option) const;

  bool operator==(const TelnetOptions&) const = default;
  void write_state(StateWriter& out) const { out.add(peer_.on, peer_.asked, own_.on, own_.asked); }

 private:
  // A bit for each accepted option.
  struct OptionBits {
    std::uint8_t on = 0;
    std::uint8_t asked = 0;
    bool operator==(const OptionBits&) const = default;
  };
  OptionBits& options(Side side) { return side == Side::kPeer ? peer_ : own_; }
  const OptionBits& options(Side side) const { return side == Side::kPeer ? peer_ : own_; }

  OptionBits peer_;
  OptionBits own_;
};

}  // namespace xr3
