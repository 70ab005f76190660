#include "cell/counters.hpp"

namespace xr3 {

CellCounters& CellCounters::operator+=(const CellCounters& cell) {
  lines_total += cell.lines_total;
  for (std::size_t i = 0; i < lines_closed.size(); ++i) lines_closed[i] += cell.lines_closed[i];
  bytes_in += cell.bytes_in;
  bytes_out += cell.bytes_out;
  for (std::size_t i = 0; i < commands.size(); ++i) commands[i] += cell.commands[i];
  for (const auto& [code, count] : cell.warnings) warnings[code] += count;
  ticks += cell.ticks;
  return *this;
}

}  // namespace xr3
