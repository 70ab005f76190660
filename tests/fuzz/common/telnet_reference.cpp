#include "tests/fuzz/common/telnet_reference.hpp"

#include <optional>

namespace xr3::fuzz {
namespace {

using Byte = unsigned char;
using std::string_literals::operator""s;

constexpr Byte kEnd = 0xf0;  // also the lowest command
constexpr Byte kInterrupt = 0xf4;
constexpr Byte kBegin = 0xfa;
constexpr Byte kWill = 0xfb;
constexpr Byte kWont = 0xfc;
constexpr Byte kDo = 0xfd;
constexpr Byte kDont = 0xfe;
constexpr Byte kIac = 0xff;
constexpr Byte kTimingMark = 6;
constexpr Byte kComPort = 44;
constexpr int kMaxContent = 512;
const std::string kModemState = "\x6b\xb0";

Byte byte_at(std::string_view text, std::size_t at) { return static_cast<Byte>(text[at]); }

std::string doubled(std::string_view text) {
  std::string all;
  for (const char byte : text) all.append(byte == '\xff' ? 2 : 1, byte);
  return all;
}

}  // namespace

/// The first data byte or command of a stream.
struct TelnetReference::Unit {
  std::size_t size = 0;  ///< 0: incomplete
  std::optional<char> data{};
  Byte command = 0;
  Byte option = 0;
  std::optional<std::string> content{};  ///< of a complete subnegotiation
};

namespace {

/// The content of the subnegotiation at the beginning, and its size; {0, {}} if it is incomplete.
std::pair<std::size_t, std::optional<std::string>> subnegotiation(std::string_view rest) {
  std::string content;
  int length = 0;
  for (std::size_t i = 2; i < rest.size(); ++i) {
    const bool is_command = byte_at(rest, i) == kIac;
    if (is_command && ++i == rest.size()) break;
    if (is_command && byte_at(rest, i) == kEnd) return {i + 1, content};
    if (!is_command || byte_at(rest, i) == kIac) content += rest[i];
    if (++length > kMaxContent) return {i + 1, std::nullopt};
  }
  return {0, std::nullopt};
}

}  // namespace

TelnetReference::TelnetReference(std::function<std::string(char)> robot, std::size_t most_held)
    : robot_(std::move(robot)),
      most_held_(most_held),
      settings_{{1, "\0\0\x25\x80"s}, {2, "\x07"}, {3, "\x03"}, {4, "\x02"}},
      controls_{{0, 1}, {4, 6}, {7, 8}, {10, 11}, {13, 14}} {}

TelnetReference::Unit TelnetReference::first_unit(std::string_view rest) const {
  if (rest.empty()) return {};
  if (byte_at(rest, 0) != kIac) return {1, rest[0]};
  if (rest.size() < 2) return {};
  const Byte command = byte_at(rest, 1);
  if (command == kIac || command < kEnd) return {2, rest[1]};
  if (command == kBegin) {
    auto [size, content] = subnegotiation(rest);
    return {size, {}, command, 0, std::move(content)};
  }
  if (command < kBegin) return {2, {}, command};
  return rest.size() < 3 ? Unit{} : Unit{3, {}, command, byte_at(rest, 2)};
}

std::string TelnetReference::all_sent(std::string_view bytes) {
  for (Unit unit = first_unit(bytes); unit.size > 0; unit = first_unit(bytes)) {
    bytes.remove_prefix(unit.size);
    handle(unit);
  }
  resume();
  return sent_;
}

void TelnetReference::handle(const Unit& unit) {
  if (unit.data) {
    if (held_.size() >= most_held_) {
      has_ended_ = true;
      resume();
    }
    return reply(robot_(*unit.data));
  }
  is_telnet_ |= unit.command == kInterrupt || unit.command >= kWill || unit.content.has_value();
  if (unit.command >= kWill) option(unit.command, unit.option);
  if (unit.content) request(*unit.content);
}

void TelnetReference::option(Byte verb, Byte option) {
  const bool is_clients = verb == kWill || verb == kWont;
  const char yes = static_cast<char>(is_clients ? kDo : kWill);
  const char no = static_cast<char>(is_clients ? kDont : kWont);
  const auto say = [&](char word) { sent_ += {'\xff', word, static_cast<char>(option)}; };
  const Option place{is_clients, option};
  const bool had_com_port = has_com_port();
  if (verb == kWont || verb == kDont) {
    if (on_.erase(place) > 0) say(no);
    if (had_com_port && !has_com_port()) resume();
    return;
  }
  if (verb == kDo && option == kTimingMark) return say(yes);
  if (option != 0 && option != 3 && option != kComPort) return say(no);
  if (!on_.insert(place).second) return;
  say(yes);
  if (verb == kWill && option == kComPort) answer(kModemState);
}

void TelnetReference::request(std::string_view content) {
  if (!has_com_port() || content.size() < 2 || byte_at(content, 0) != kComPort) return;
  const char code = content[1];
  const std::string value(content.substr(2));
  const std::size_t size = value.size();
  if (code == 0 && size == 0) answer("dxr3");
  if ((code == 1 && size == 4) || (code >= 2 && code <= 4 && size == 1)) set(code, value);
  if (code == 5 && size == 1) control(value[0]);
  if (code == 7 && size == 0) answer(kModemState);
  if (code == 8 && size == 0) is_suspended_ = !has_ended_;
  if (code == 9 && size == 0) resume();
  if (code == 12 && (value == "\x01" || value == "\x03")) held_.clear();
  if (code >= 10 && code <= 12 && size == 1) answer(static_cast<char>(code + 100) + value);
}

void TelnetReference::set(char code, std::string value) {
  const bool is_known = code == 1 || (code == 2 && value[0] >= 5 && value[0] <= 8) ||
                        (code == 3 && value[0] >= 1 && value[0] <= 5) ||
                        (code == 4 && value[0] >= 1 && value[0] <= 3);
  if (value.find_first_not_of('\0') == std::string::npos) {
    value = settings_[code];
  } else if (is_known) {
    settings_[code] = value;
  }
  answer(static_cast<char>(code + 100) + value);
}

void TelnetReference::control(char value) {
  const std::map<char, std::string> sets{{0, "\x01\x02\x03\x11\x13"},
                                         {4, "\x05\x06"},
                                         {7, "\x08\x09"},
                                         {10, "\x0b\x0c"},
                                         {13, "\x0e\x0f\x10\x12"}};
  for (const auto& [asks, values] : sets) {
    if (values.find(value) != std::string::npos) controls_[asks] = value;
  }
  const auto asked = controls_.find(value);
  answer(std::string{'\x69', asked == controls_.end() ? value : asked->second});
}

void TelnetReference::answer(std::string_view answer) {
  sent_ += "\xff\xfa\x2c" + doubled(answer) + "\xff\xf0";
}

void TelnetReference::reply(std::string_view replies) {
  if (is_suspended_) {
    held_ += replies;
  } else {
    sent_ += is_telnet_ ? doubled(replies) : std::string(replies);
  }
}

void TelnetReference::resume() {
  is_suspended_ = false;
  reply(std::exchange(held_, {}));
}

bool TelnetReference::has_com_port() const {
  return on_.contains({true, kComPort}) || on_.contains({false, kComPort});
}

}  // namespace xr3::fuzz
