// The calls on serial lines: `send`, `lines`, `line_disconnect`, `peer_release` and `transcript`.
#include <charconv>
#include <string_view>
#include <utility>

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxSent = 4096;  // bytes of a `send`

std::optional<std::string> from_hexadecimal(std::string_view digits) {
  std::string bytes;
  for (; digits.size() >= 2; digits.remove_prefix(2)) {
    const char* end = digits.data() + 2;
    std::uint8_t byte = 0;
    if (std::from_chars(digits.data(), end, byte, 16).ptr != end) return std::nullopt;
    bytes.push_back(static_cast<char>(byte));
  }
  return digits.empty() ? std::optional(std::move(bytes)) : std::nullopt;
}

data::Codec<std::string> bytes_in_hexadecimal() {
  const auto parse = [](JsonValue value) -> std::optional<std::string> {
    const std::string digits = value.is_text() ? value.text(2 * kMaxSent + 1) : "?";
    return digits.size() <= 2 * kMaxSent ? from_hexadecimal(digits) : std::nullopt;
  };
  return data::parsed<std::string>(
      "two hexadecimal digits a byte, at most " + std::to_string(kMaxSent) + " bytes", parse);
}

CallValue read_send(ArgsReader& args) {
  auto text = args.coded("text", data::text(0, kMaxSent), Presence::kOptional);
  auto bytes = args.coded("hex", bytes_in_hexadecimal(), Presence::kOptional);
  args.has_one_of("text", "hex");
  return Send{text ? *std::move(text) : std::move(bytes).value_or("")};
}

CallValue read_line_disconnect(ArgsReader& args) {
  return DisconnectLine{
      static_cast<std::uint32_t>(args.integer("line", 1, UINT32_MAX).value_or(1))};
}

constexpr CallForm kLineCalls[] = {
    {"send", "Sends bytes on a serial line that belongs to this client.", read_send},
    {"lines", "Lists the open serial lines, and the physical controller.", read_nothing<ListLines>},
    {"line_disconnect", "Closes a serial line.", read_line_disconnect},
    {"peer_release",
     "Closes the lines of the address that keeps the robot port, and frees the port.",
     read_nothing<ReleasePeer>},
    {"transcript", "Gives a digest of all bytes of the lines in this epoch, and of the state.",
     read_nothing<ReadTranscript>},
};

}  // namespace

CallForms line_calls() { return kLineCalls; }

}  // namespace xr3::monitor
