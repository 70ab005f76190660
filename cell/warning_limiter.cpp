#include "cell/warning_limiter.hpp"

#include <utility>

namespace xr3 {

bool WarningLimiter::extends_run(LineId line, Tick tick, std::string_view code) {
  const auto found = lines_.find(line);
  if (found == lines_.end()) return false;
  PerLine& of_line = found->second;
  if (!of_line.run) return false;
  const bool extends = of_line.run->code == code && of_line.second == tick / kTickHz;
  if (extends) ++of_line.run->count;
  return extends;
}

std::vector<CellNote> WarningLimiter::add(LineId line, Tick tick, ProblemNote note) {
  if (extends_run(line, tick, note.code)) return {};
  PerLine& of_line = lines_[line];
  std::vector<CellNote> due = begin_second(of_line, tick);
  end_run(of_line, due);
  note.first_tick = tick;
  of_line.run = std::move(note);
  return due;
}

std::vector<CellNote> WarningLimiter::finish(LineId line, Tick tick) {
  const auto found = lines_.find(line);
  if (found == lines_.end()) return {};
  std::vector<CellNote> due = begin_second(found->second, tick);
  end_run(found->second, due);
  return due;
}

std::vector<CellNote> WarningLimiter::begin_second(PerLine& line, Tick tick) {
  const Tick second = tick / kTickHz;
  if (second == line.second) return {};
  std::vector<CellNote> due;
  end_run(line, due);
  flush(line, due);
  line.second = second;
  line.notes = 0;
  return due;
}

void WarningLimiter::flush(PerLine& line, std::vector<CellNote>& due) {
  if (line.left_out == 0) return;
  due.emplace_back(SuppressedNote{line.left_out});
  line.left_out = 0;
  --pending_lines_;
}

std::vector<std::pair<LineId, CellNote>> WarningLimiter::take_pending(Tick tick) {
  std::vector<std::pair<LineId, CellNote>> reports;
  if (pending_lines_ == 0) return reports;
  for (auto& [id, line] : lines_) {
    if (line.left_out == 0) continue;
    for (CellNote& note : begin_second(line, tick)) reports.emplace_back(id, std::move(note));
  }
  return reports;
}

std::vector<CellNote> WarningLimiter::forget(LineId line) {
  const auto found = lines_.find(line);
  if (found == lines_.end()) return {};
  std::vector<CellNote> due;
  end_run(found->second, due);
  flush(found->second, due);
  lines_.erase(found);
  return due;
}

void WarningLimiter::end_run(PerLine& line, std::vector<CellNote>& due) {
  if (!line.run) return;
  if (line.notes < kMaxNotesPerSecond) {
    ++line.notes;
    due.emplace_back(std::move(*line.run));
  } else {
    if (line.left_out == 0) ++pending_lines_;
    line.left_out += line.run->count;
  }
  line.run.reset();
}

}  // namespace xr3
