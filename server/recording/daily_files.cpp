#include "server/recording/daily_files.hpp"

namespace xr3 {

DailyFiles::DailyFiles(Cell& cell, std::function<void()> begin_file, Now now)
    : cell_(cell), begin_file_(std::move(begin_file)), now_(std::move(now)), day_(day_of(now_())) {
  cell_.observe(*this);
}

void DailyFiles::before(const Cell& cell, const Input&) {
  if (!cell.lines().empty()) return;
  const Day today = day_of(now_());
  if (std::exchange(day_, today) != today) begin_file_();
}

DailyFiles::Day DailyFiles::day_of(std::time_t time) {
  std::tm local{};
  ::localtime_r(&time, &local);
  return {local.tm_year, local.tm_yday};
}

}  // namespace xr3
