// The settings of a serial port: speed, frame and flow control. Values with a text form, such as
// `9600-7e2`, in options and messages. They record the settings on the program's side, and have no
// effect on the bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace xr3 {

enum class Parity : std::uint8_t { kNone, kOdd, kEven, kMark, kSpace };
enum class StopBits : std::uint8_t { kOne, kTwo, kOneAndAHalf };
enum class FlowControl : std::uint8_t { kNone, kSoftware, kHardware };

/// The speed of the Mark III controller's port.
inline constexpr std::uint32_t kDefaultBaud = 9600;
inline constexpr int kMinDataBits = 5;
inline constexpr int kMaxDataBits = 8;

/// The frame of a character. The default is that of the Mark III controller's port.
struct SerialFrame {
  std::uint8_t data_bits = 7;  ///< kMinDataBits to kMaxDataBits
  Parity parity = Parity::kEven;
  StopBits stop_bits = StopBits::kTwo;
  FlowControl flow = FlowControl::kNone;

  bool operator==(const SerialFrame&) const = default;
};

struct SerialSettings {
  std::uint32_t baud = kDefaultBaud;  ///< not 0
  std::optional<SerialFrame> frame;   ///< nullopt if not known

  bool operator==(const SerialSettings&) const = default;
};

/// The text form, `9600-7e2`: speed, data bits, parity (n, o, e, m or s) and stop bits (1, 1.5 or
/// 2), then `-xonxoff` or `-rtscts` if there is flow control. Only the speed if the frame is not
/// known.
std::string text_of(const SerialSettings& settings);

/// Reads the form of text_of(); letters in either case. nullopt if the text has another form, a
/// speed of 0 or one above 32 bits.
std::optional<SerialSettings> parse_serial_settings(std::string_view text);

}  // namespace xr3
