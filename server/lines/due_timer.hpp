// Advances the cell when a byte of a line is due, if nothing else does so before.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "cell/cell.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class DueTimer {
 public:
  /// `on_input` is called after the cell has advanced.
  DueTimer(asio::io_context& io, Cell& cell, std::function<void()> on_input)
      : cell_(cell), on_input_(std::move(on_input)), timer_(io) {}

  /// Waits for the byte that is due next. To be called after each input of the cell.
  void update();
  void close();

 private:
  void advance();

  Cell& cell_;
  std::function<void()> on_input_;
  asio::steady_timer timer_;
  std::optional<WallNs> waits_until_;
  bool is_closed_ = false;
};

}  // namespace xr3
