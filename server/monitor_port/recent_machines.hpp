// The machines whose connections over HTTP have ended a short time ago: a silent connection of one
// is probably one that a browser has opened ahead.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "server/net/asio.hpp"

namespace xr3 {

class RecentMachines {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::seconds kRemembered{60};
  static constexpr std::size_t kMost = 256;  ///< the latest note replaces the oldest

  void note(const asio::ip::address& machine, Time now);

  /// Whether the machine was noted within kRemembered before `now`.
  bool contains(const asio::ip::address& machine, Time now) const;

 private:
  struct Noted {
    asio::ip::address machine;
    Time at = Time::min();
  };

  std::array<Noted, kMost> noted_;  ///< each machine at most once
};

}  // namespace xr3
