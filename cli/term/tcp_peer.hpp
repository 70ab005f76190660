// A TCP connection as the line of `xr3 term`, raw or with RFC 2217.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "cli/options/term.hpp"
#include "cli/term/peer.hpp"
#include "protocol/line/telnet_client.hpp"

namespace xr3 {

class TcpPeer : public TermPeer {
 public:
  /// With `telnet`, the connection uses RFC 2217.
  TcpPeer(tcp::socket socket, std::optional<TelnetClient> telnet)
      : socket_(std::move(socket)), telnet_(std::move(telnet)) {}

  /// Negotiates, until the settings of the port are answered. False if the connection is lost.
  asio::awaitable<bool> negotiate();
  const std::optional<TelnetClient>& telnet() const { return telnet_; }

  asio::awaitable<std::string_view> read() override;
  asio::awaitable<bool> write(std::string_view data) override;
  asio::awaitable<std::string> send_break() override;
  bool has_protocol_bytes() const override { return !protocol_bytes_.empty(); }
  bool is_suspended() const override { return telnet_ && telnet_->is_suspended(); }
  void when_protocol(std::function<void()> due) override { due_ = std::move(due); }
  bool finish() override;

 private:
  void filter(std::string_view bytes);

  tcp::socket socket_;
  std::optional<TelnetClient> telnet_;
  std::string protocol_bytes_;  ///< sent before the next data
  std::function<void()> due_;
  std::array<char, 8192> buffer_{};
  std::string early_data_;  ///< received while negotiating
  std::string data_;        ///< data of the last read(), with telnet
};

/// Connects, and negotiates if the options say so. Throws ExitError if the connection does not
/// answer within 5 s.
std::unique_ptr<TcpPeer> connect_peer(asio::io_context& context, const TermOptions& options);

}  // namespace xr3
