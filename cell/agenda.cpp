#include "cell/agenda.hpp"

#include <cassert>

namespace xr3 {

const Due& Agenda::first() const {
  assert(!empty());
  return *dues_.begin();
}

void Agenda::set(LineId line, Direction direction, std::optional<Micros> at) {
  const std::pair key{line, direction};
  const auto found = moments_.find(key);
  if (found != moments_.end()) {
    if (found->second == at) return;
    dues_.erase({found->second, line, direction});
    moments_.erase(found);
  }
  if (!at) return;
  moments_.emplace(key, *at);
  dues_.insert({*at, line, direction});
}

void Agenda::forget(LineId line) {
  set(line, Direction::kIn, std::nullopt);
  set(line, Direction::kOut, std::nullopt);
}

}  // namespace xr3
