#include "cell/agenda.hpp"

namespace xr3 {

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

}  // namespace xr3
