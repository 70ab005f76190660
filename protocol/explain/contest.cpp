#include "protocol/explain/contest.hpp"

#include <algorithm>
#include <utility>

namespace xr3 {

std::optional<ContestedNote> ContestObserver::handle(const CellEvent& event) {
  if (std::holds_alternative<EpochNote>(event.note)) last_moves_ = {};
  if (!event.line) return std::nullopt;
  if (std::holds_alternative<LineClosedNote>(event.note)) forget(*event.line);
  const auto* body = std::get_if<EventBody>(&event.note);
  const auto* move = body != nullptr ? std::get_if<MoveTaken>(body) : nullptr;
  if (move == nullptr || move->counts == 0) return std::nullopt;
  return handle_move(*event.line, event.tick, *move);
}

std::optional<ContestedNote> ContestObserver::handle_move(LineId line, Tick tick,
                                                          const MoveTaken& move) {
  LastMove& last = last_moves_.at(static_cast<std::size_t>(move.label - 'A'));
  const auto [other, other_tick] = std::exchange(last, {line, tick});
  const auto counts_to_go = static_cast<std::int8_t>(move.error - move.counts);  // before this move
  const bool is_contested = other != 0 && other != line && tick - other_tick <= kRecent &&
                            counts_to_go != 0 && contests_.size() < kMaxContests;
  if (!is_contested) return std::nullopt;
  const auto [first, second] = std::minmax(line, other);
  const bool is_new = contests_.emplace(first, second, move.label).second;
  return is_new ? std::optional(ContestedNote{other, move.label}) : std::nullopt;
}

void ContestObserver::forget(LineId line) {
  for (LastMove& last : last_moves_) {
    if (last.line == line) last = {};
  }
  std::erase_if(contests_, [line](const auto& contest) {
    return std::get<0>(contest) == line || std::get<1>(contest) == line;
  });
}

}  // namespace xr3
