#include "server/lines/turn_queue.hpp"

#include <algorithm>
#include <cassert>

namespace xr3 {
namespace {

// The first class has inquiries, also those of 68 milliseconds if a line asks once a millisecond: a
// line that has to wait among a thousand others must not count as heavier for that, and wait even
// longer. The second one has lines that request an image now and then, or inquire without end. The
// last one has many images or commands without end.
constexpr std::array<std::uint64_t, 3> kBounds = {14'000, 32'000, 64'000};

}  // namespace

std::size_t TurnQueue::class_of(std::uint64_t load) {
  static_assert(kBounds.size() + 1 == kClasses);
  const auto above = std::upper_bound(kBounds.begin(), kBounds.end(), load);
  return static_cast<std::size_t>(above - kBounds.begin());
}

// Start-time fair queueing, where each turn costs the same: a line takes part in the round that is
// under way, or in the one after that of its peer's line before.
void TurnQueue::add(SessionNumber line, std::uint64_t load, Peer& peer) {
  if (!members_.insert(line).second) return;
  const std::size_t number = class_of(load);
  Class& to = classes_[number];
  const std::uint64_t round = std::max(to.round, peer.next_round_[number]);
  peer.next_round_[number] = round + 1;
  to.lines.push({round, added_++, line});
}

bool TurnQueue::is_next(std::uint64_t load) const {
  const auto end = classes_.begin() + static_cast<std::ptrdiff_t>(class_of(load)) + 1;
  return std::none_of(classes_.begin(), end, has_lines);
}

SessionNumber TurnQueue::take(Class& from) {
  const Entry first = from.lines.top();
  from.lines.pop();
  from.round = first.round;
  members_.erase(first.line);
  return first.line;
}

SessionNumber TurnQueue::take_lightest() {
  assert(!empty());
  return take(*std::find_if(classes_.begin(), classes_.end(), has_lines));
}

std::vector<SessionNumber> TurnQueue::take_first_of_each() {
  std::vector<SessionNumber> lines;
  for (auto each = classes_.rbegin(); each != classes_.rend(); ++each)
    if (has_lines(*each)) lines.push_back(take(*each));
  return lines;
}

}  // namespace xr3
