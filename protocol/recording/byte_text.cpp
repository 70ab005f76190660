#include "protocol/recording/byte_text.hpp"

#include <nlohmann/json.hpp>

#include "protocol/explain/diagnostic.hpp"

namespace xr3::recording {
namespace {

void append_escaped(char byte, std::string& json) {
  switch (byte) {
    case '"': json += "\\\""; return;
    case '\\': json += "\\\\"; return;
    case '\r': json += "\\r"; return;
    case '\n': json += "\\n"; return;
    case '\t': json += "\\t"; return;
    default: json += "\\u00" + hexadecimal({&byte, 1});
  }
}

bool is_plain(char byte) { return byte >= ' ' && byte < '\x7f' && byte != '"' && byte != '\\'; }

/// The bytes whose code points the UTF-8 text has; nullopt if one is above U+00FF.
std::optional<std::string> bytes_of(std::string_view text) {
  constexpr unsigned kLead = 0xC2;  // begins U+0080 to U+00BF; 0xC3 those up to U+00FF
  std::string bytes;
  bytes.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<std::uint8_t>(text[i]);
    if (byte < 0x80) {
      bytes += text[i];
      continue;
    }
    if ((byte != kLead && byte != kLead + 1) || ++i == text.size()) return std::nullopt;
    bytes += static_cast<char>((byte - kLead) * 0x40U + static_cast<std::uint8_t>(text[i]));
  }
  return bytes;
}

}  // namespace

void append_byte_text(std::string_view bytes, std::string& json) {
  json += '"';
  for (const char byte : bytes) is_plain(byte) ? void(json += byte) : append_escaped(byte, json);
  json += '"';
}

data::Codec<std::string> byte_text(std::size_t most) {
  return data::parsed<std::string>(
      "text of at most " + std::to_string(most) + " characters, none above U+00FF",
      [most](JsonValue value) -> std::optional<std::string> {
        auto bytes = value.is_text() ? bytes_of(value.text()) : std::nullopt;
        return bytes && bytes->size() <= most ? std::move(bytes) : std::nullopt;
      },
      [](const std::string& bytes) {
        std::string text;
        append_byte_text(bytes, text);
        return Json::parse(text);
      });
}

}  // namespace xr3::recording
