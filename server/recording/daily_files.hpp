// The days of a recording: the first input of a day, as the clock on the wall shows it, begins a
// new file, unless a line is open.
#pragma once

#include <ctime>
#include <functional>
#include <utility>

#include "cell/cell.hpp"

namespace xr3 {

class DailyFiles final : public CellObserver {
 public:
  using Now = std::function<std::time_t()>;

  /// `begin_file` is called before the input acts; it must not throw. Observes the cell before
  /// observers that are added later.
  DailyFiles(
      Cell& cell, std::function<void()> begin_file, Now now = [] { return std::time(nullptr); });
  ~DailyFiles() override { cell_.end_observation(*this); }

  void before(const Cell& cell, const Input& input) override;

 private:
  /// A day of the local time.
  using Day = std::pair<int, int>;
  static Day day_of(std::time_t time);

  Cell& cell_;
  std::function<void()> begin_file_;
  Now now_;
  Day day_;
};

}  // namespace xr3
