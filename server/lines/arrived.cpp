#include "server/lines/arrived.hpp"

#include <algorithm>

namespace xr3 {

bool ArrivedBytes::read(WallNs end) {
  do {
    if (lines_.empty()) return false;
    read_next();
  } while (wall_now() < end);
  return !lines_.empty();
}

void ArrivedBytes::read_next() {
  Line line = lines_.front();
  lines_.pop_front();
  const auto session = line.session.lock();  // null: it has ended
  if (!session || !session->is_open()) return;
  const bool is_first = !line.limits;
  if (is_first) line.limits = session->arrived_limits();
  if (!is_first && is_over(*session, *line.limits)) return wake_(session->line());
  if (read_round(*session, *line.limits)) lines_.push_back(line);
}

bool ArrivedBytes::is_over(const LineSession& session, const LineSession::Limits& limits) const {
  return left_ == 0 || limits.most_read == 0 || session.is_over(limits, wall_now());
}

bool ArrivedBytes::read_round(LineSession& session, LineSession::Limits& limits) {
  const std::size_t before = limits.most_read;
  const bool has_more = session.read_arrived(limits, kRound);
  left_ -= std::min(left_, before - limits.most_read);
  return has_more;
}

}  // namespace xr3
