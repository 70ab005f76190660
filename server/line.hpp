// A virtual serial line: what stands between a transport and the controller. A chain of filters
// (guard against strangers, telnet), the endpoint with its parser, and an outbox. It knows no socket:
// TCP, a console or a test's memory are its transports.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "protocol/rhino_endpoint.hpp"
#include "protocol/stranger_guard.hpp"
#include "protocol/telnet.hpp"

namespace xr3 {

/// Lines are numbered from 1 in the order in which they were opened.
using LineId = std::uint32_t;

class Line {
 public:
  /// Above this the line takes no further byte until its transport has taken replies.
  static constexpr std::size_t kFullOutbox = 64 * 1024;

  Line(Profile profile, std::string peer, Tick opened)
      : endpoint_(profile), peer_(std::move(peer)), opened_(opened) {}

  /// Takes bytes at the simulation's tick and returns how many: all, unless the outbox is full or the
  /// client turned out to be a stranger.
  std::size_t receive(std::string_view bytes, Simulation& simulation,
                      std::vector<Exchange>& exchanges);

  /// Puts reply bytes into the outbox, as the client's end must see them.
  void deliver(std::string_view replies);

  bool is_full() const { return outbox_.size() >= kFullOutbox; }
  /// A browser or a TLS client: to be closed; nothing that it sent has acted.
  bool is_stranger() const { return is_stranger_; }
  /// Bytes that the guard still holds back.
  std::size_t held_bytes() const { return guard_.held().size(); }
  bool is_telnet() const { return telnet_.is_telnet(); }
  /// As it is before the next byte.
  const TelnetFilter& telnet() const { return telnet_; }

  /// Bytes for the transport; whoever sends some removes them by sent().
  std::string_view outbox() const { return outbox_; }
  void sent(std::size_t count);

  /// Forgets commands that have begun.
  void reset() { endpoint_.reset(); }

  const std::string& peer() const { return peer_; }
  Tick opened_tick() const { return opened_; }
  std::uint64_t bytes_in() const { return bytes_in_; }
  std::uint64_t bytes_out() const { return bytes_out_; }
  /// Where the next byte of output will stand, the outbox counted.
  std::uint64_t output_end() const { return bytes_out_ + outbox_.size(); }

 private:
  void act(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
           std::vector<Exchange>& exchanges);

  StrangerGuard guard_;
  TelnetFilter telnet_;
  RhinoEndpoint endpoint_;
  std::string outbox_;
  std::string peer_;
  Tick opened_;
  std::uint64_t bytes_in_ = 0;  ///< as the transport delivered them, telnet and held bytes included
  std::uint64_t bytes_out_ = 0;  ///< as the transport took them
  bool is_stranger_ = false;
};

}  // namespace xr3
