// Deletes the recordings of several cells that are older than some days (`--record-keep`): at the
// start, and then once a day.
#pragma once

#include <functional>
#include <string>

#include "server/net/asio.hpp"

namespace xr3 {

class Retention {
 public:
  /// `is_kept`: see delete_old_recordings(). No effect if `days` is 0.
  Retention(asio::io_context& io, std::string folder, int days,
            std::function<bool(const std::string& path)> is_kept);
  Retention(const Retention&) = delete;
  Retention& operator=(const Retention&) = delete;

  /// Begins to delete in the event loop, with a pause after the folder of each cell.
  void begin();

 private:
  asio::awaitable<void> run();
  asio::awaitable<void> delete_old();

  std::string folder_;
  int days_;
  std::function<bool(const std::string& path)> is_kept_;
  asio::steady_timer timer_;
};

}  // namespace xr3
