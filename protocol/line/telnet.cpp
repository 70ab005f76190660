#include "protocol/line/telnet.hpp"

#include <span>

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {

using enum TelnetOptions::Side;

static_assert(TelnetParser::kMaxKept == 1 + ComPort::kMaxRequest + 1);

TelnetInput TelnetFilter::handle(const TelnetItem& item, std::string& answers) {
  switch (item.kind) {
    case TelnetItem::ItemKind::kNothing: return {};
    case TelnetItem::ItemKind::kData: return {item.byte};
    case TelnetItem::ItemKind::kCommand: is_telnet_ |= item.byte == telnet::kInterrupt; return {};
    case TelnetItem::ItemKind::kOption: return {std::nullopt, negotiate(item, answers)};
    case TelnetItem::ItemKind::kSubnegotiation: return {std::nullopt, end_subnegotiation(answers)};
  }
  return {};
}

// Negotiates an option. After COM-PORT has been switched off, no RESUME can arrive.
BufferControl TelnetFilter::negotiate(const TelnetItem& item, std::string& answers) {
  is_telnet_ = true;
  const bool had_com_port = has_com_port();
  const bool client_had_it = options_.is_on(kPeer, telnet::kComPort);
  options_.negotiate(item.byte, item.option, answers);
  const bool client_has_it = options_.is_on(kPeer, telnet::kComPort);
  if (client_has_it && !client_had_it) ComPort::append_modem_state(answers);
  return had_com_port && !has_com_port() ? BufferControl::kResume : BufferControl::kNone;
}

BufferControl TelnetFilter::end_subnegotiation(std::string& answers) {
  is_telnet_ = true;
  const std::span<const std::uint8_t> kept = parser_.subnegotiation();
  const bool is_request = !kept.empty() && kept[0] == telnet::kComPort && has_com_port();
  if (!is_request) return BufferControl::kNone;
  return com_port_.handle(kept.subspan(1), answers);
}

bool TelnetFilter::has_com_port() const {
  return options_.is_on(kPeer, telnet::kComPort) || options_.is_on(kOwn, telnet::kComPort);
}

std::optional<SerialSettings> TelnetFilter::settings() const {
  return has_com_port() ? std::optional(com_port_.settings()) : std::nullopt;
}

void TelnetFilter::encode(std::string_view replies, std::string& out) const {
  if (is_telnet_) return append_escaped(out, replies);
  out.append(replies);  // replies with a picture have hundreds of kilobytes
}

}  // namespace xr3
