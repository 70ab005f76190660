#include "server/lines/arrived.hpp"

#include <algorithm>

namespace xr3 {

void ArrivedBytes::add(SessionNumber number, const std::shared_ptr<LineSession>& session) {
  if (!session->is_open()) return;
  const std::uint64_t start = session->bytes_in();
  lines_.push_back({number, session, start, start + session->arrived_bytes(),
                    start + std::min(kMaxBytes, session->max_settled()),
                    session->output_end() + kMaxReplies});
}

bool ArrivedBytes::read(WallNs end) {
  do {
    if (lines_.empty()) return false;
    Line line = lines_.front();
    lines_.pop_front();
    if (run_turn(line)) lines_.push_back(line);
  } while (wall_now() < end);
  return !lines_.empty();
}

/// Returns whether the line has more to read.
bool ArrivedBytes::run_turn(Line& line) {
  const LineSession::Turn turn = turns_.run_turn(line.number);
  const auto session = line.session.lock();
  const bool may_have_more = turn != LineSession::Turn::kBlocked && session && session->is_open();
  return may_have_more && has_more(line, *session);
}

bool ArrivedBytes::has_more(Line& line, const LineSession& session) {
  const std::uint64_t now = session.bytes_in();
  const std::uint64_t count = now - line.start;
  if (now >= line.last_end || session.output_end() >= line.replies_end) return false;
  const std::size_t arrived = session.arrived_bytes();
  if (count >= kBurst) line.end = now + arrived;
  return now < line.end && arrived > 0;
}

}  // namespace xr3
