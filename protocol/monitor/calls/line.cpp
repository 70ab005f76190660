// The calls on serial lines: `send`, `lines`, `line_disconnect` and `transcript`.
#include <utility>

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxSent = 4096;  // bytes of a `send`

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::optional<std::string> from_hexadecimal(const std::string& digits) {
  if (digits.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const int high = digit(digits[i]);
    const int low = digit(digits[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<char>(high * 16 + low));
  }
  return bytes;
}

data::Codec<std::string> bytes_in_hexadecimal() {
  data::Codec<std::string> codec;
  codec.allowed = "two hexadecimal digits a byte, at most " + std::to_string(kMaxSent) + " bytes";
  codec.read = [allowed = codec.allowed](const data::Place& place, std::string& bytes) {
    if (!place.value.is_text()) return place.refuse(allowed);
    const std::string digits = place.value.text(2 * kMaxSent + 1);
    auto read = digits.size() <= 2 * kMaxSent ? from_hexadecimal(digits) : std::nullopt;
    if (!read) return place.refuse(allowed);
    return bytes = *std::move(read), true;
  };
  return codec;
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
    {"transcript", "Gives a digest of all bytes of the lines in this epoch, and of the state.",
     read_nothing<ReadTranscript>},
};

}  // namespace

CallForms line_calls() { return kLineCalls; }

}  // namespace xr3::monitor
