#include "server/recording/retention.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "server/net/spawn.hpp"
#include "server/recording/folder.hpp"

namespace xr3 {
namespace {

// Other work of the event loop has its turn between the folders of two cells.
constexpr std::chrono::milliseconds kPause{5};
constexpr std::chrono::hours kDay{24};

}  // namespace

Retention::Retention(asio::io_context& io, std::string folder, int days,
                     std::function<bool(const std::string& path)> is_kept)
    : folder_(std::move(folder)), days_(days), is_kept_(std::move(is_kept)), timer_(io) {}

void Retention::begin() {
  if (days_ > 0) spawn_loop(timer_.get_executor(), "the deletion of recordings", run());
}

asio::awaitable<void> Retention::run() {
  while (true) {
    co_await delete_old();
    timer_.expires_after(kDay);
    co_await timer_.async_wait(kAwait);
  }
}

asio::awaitable<void> Retention::delete_old() {
  const auto oldest = std::chrono::system_clock::now() - days_ * kDay;
  std::size_t deleted = 0;
  for (const std::string& of_cell : folders_of_cells(folder_)) {
    deleted += delete_old_recordings(of_cell, oldest, is_kept_);
    timer_.expires_after(kPause);
    co_await timer_.async_wait(kAwait);
  }
  if (deleted > 0)
    spdlog::info("{}: {} recordings older than {} days are deleted (--record-keep)", folder_,
                 deleted, days_);
}

}  // namespace xr3
