#include "protocol/line/serial_settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

// Letters in the order of the enumerations.
constexpr std::string_view kParities = "noems";
constexpr std::array kStopBits = {"1"sv, "2"sv, "1.5"sv};
constexpr std::array kFlows = {""sv, "-xonxoff"sv, "-rtscts"sv};

template <class Value, std::size_t Size>
std::optional<Value> find_name(const std::array<std::string_view, Size>& names,
                               std::string_view name) {
  const auto* found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Value>(found - names.begin());
}

std::string lower(std::string_view text) {
  std::string all(text);
  for (char& letter : all) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return all;
}

/// Parses `7e2` and an optional flow control.
std::optional<SerialFrame> parse_frame(std::string_view text) {
  if (text.size() < 3) return std::nullopt;
  const auto data_bits = static_cast<std::uint8_t>(text[0] - '0');
  const std::size_t parity = kParities.find(text[1]);
  const std::size_t end = std::min(text.find('-'), text.size());
  const auto stop_bits = find_name<StopBits>(kStopBits, text.substr(2, end - 2));
  const auto flow = find_name<FlowControl>(kFlows, text.substr(end));
  const bool is_size = data_bits >= kMinDataBits && data_bits <= kMaxDataBits;
  if (!is_size || parity == std::string_view::npos || !stop_bits || !flow) return std::nullopt;
  return SerialFrame{data_bits, static_cast<Parity>(parity), *stop_bits, *flow};
}

}  // namespace

std::string text_of(const SerialSettings& settings) {
  std::string text = std::to_string(settings.baud);
  if (!settings.frame) return text;
  const SerialFrame& frame = *settings.frame;
  text += '-';
  text += std::to_string(frame.data_bits);
  text += kParities[static_cast<std::size_t>(frame.parity)];
  text += kStopBits[static_cast<std::size_t>(frame.stop_bits)];
  text += kFlows[static_cast<std::size_t>(frame.flow)];
  return text;
}

std::optional<SerialSettings> parse_serial_settings(std::string_view text) {
  const std::string all = lower(text);
  SerialSettings settings;
  const char* const end = all.data() + all.size();
  const auto [rest, error] = std::from_chars(all.data(), end, settings.baud);
  if (error != std::errc() || settings.baud == 0) return std::nullopt;
  if (rest == end) return settings;
  if (*rest != '-') return std::nullopt;
  settings.frame = parse_frame({rest + 1, static_cast<std::size_t>(end - rest - 1)});
  return settings.frame ? std::optional(settings) : std::nullopt;
}

}  // namespace xr3
