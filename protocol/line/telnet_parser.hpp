// Separates the data of a telnet stream from its commands, options and subnegotiations (RFC 854,
// 855). It answers nothing, so that both sides of a connection can use it. A copyable value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/line/state_writer.hpp"
#include "protocol/line/telnet_codes.hpp"

namespace xr3 {

/// The item that a byte of the stream completes.
struct TelnetItem {
  enum class ItemKind : std::uint8_t { kNothing, kData, kCommand, kOption, kSubnegotiation };
  ItemKind kind = ItemKind::kNothing;
  std::uint8_t byte = 0;    ///< the data, the command, or the option's WILL, WONT, DO or DONT
  std::uint8_t option = 0;  ///< kOption: the option
};

class TelnetParser {
 public:
  /// A subnegotiation longer than this is abandoned.
  static constexpr int kMaxSubnegotiationBytes = 512;
  /// The bytes kept of a subnegotiation: an option and a COM-PORT request with a speed, and one
  /// more, which shows that the request is too long.
  static constexpr std::size_t kMaxKept = 7;

  TelnetItem feed(std::uint8_t byte) {
    if (is_plain(byte)) return {TelnetItem::ItemKind::kData, byte};
    return feed_protocol(byte);
  }

  /// Whether feed() would return this byte as data and change nothing. Almost every byte is plain.
  bool is_plain(std::uint8_t byte) const {
    return mode_ == TelnetMode::kData && byte != telnet::kIac;
  }

  /// Whether feed() would return this byte as data.
  bool is_data(std::uint8_t byte) const;

  /// The last subnegotiation: its option and the first bytes after it. Call when feed() has
  /// returned kSubnegotiation.
  std::span<const std::uint8_t> subnegotiation() const {
    return std::span(kept_).first(kept_bytes_);
  }

  bool operator==(const TelnetParser&) const = default;
  void write_state(StateWriter& out) const { out.add(mode_, verb_, length_, kept_, kept_bytes_); }

 private:
  enum class TelnetMode : std::uint8_t {
    kData,
    kCommand,
    kOption,
    kSubnegotiation,
    kSubnegotiationCommand
  };

  TelnetItem feed_protocol(std::uint8_t byte);
  TelnetItem feed_command(std::uint8_t byte);
  TelnetItem feed_subnegotiation(std::uint8_t byte);
  void keep(std::uint8_t byte);

  TelnetMode mode_ = TelnetMode::kData;
  std::uint8_t verb_ = 0;  ///< WILL, WONT, DO or DONT before an option
  std::uint8_t kept_bytes_ = 0;
  /// Bytes of the subnegotiation so far; a command in it counts as one byte.
  std::uint16_t length_ = 0;
  std::array<std::uint8_t, kMaxKept> kept_{};
};

}  // namespace xr3
