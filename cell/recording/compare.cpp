// The comparison of a replay with its recording.
#include <algorithm>

#include "cell/recording/replayer.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxShown = 60;

std::string in_quotes(std::string_view bytes) {
  const std::string text = readable(bytes.substr(0, kMaxShown));
  return "\"" + text + (bytes.size() > kMaxShown ? "..." : "") + "\"";
}

}  // namespace

Replayer::Result Replayer::compare_replies(LineId line, Tick tick, std::string_view expected) {
  auto& runs = replies_[line];
  while (!expected.empty() && !runs.empty() && runs.front().tick == tick) {
    std::string& found = runs.front().bytes;
    const std::size_t count = std::min(expected.size(), found.size());
    if (expected.substr(0, count) != std::string_view(found).substr(0, count)) {
      Result other = difference("reply", in_quotes(expected), in_quotes(found), line);
      other->tick = tick;
      return other;
    }
    expected.remove_prefix(count);
    found.erase(0, count);
    if (found.empty()) runs.pop_front();
  }
  Result other;
  if (!expected.empty()) {
    const std::string found = runs.empty() ? "no more bytes"
                                           : in_quotes(runs.front().bytes) + " at tick " +
                                                 std::to_string(runs.front().tick);
    other =
        difference("reply", in_quotes(expected) + " at tick " + std::to_string(tick), found, line);
    other->tick = tick;
  }
  if (runs.empty()) replies_.erase(line);
  return other;
}

Replayer::Result Replayer::refuse_other_replies() const {
  if (replies_.empty()) return std::nullopt;
  const auto& [line, runs] = *replies_.begin();
  Result other = difference("reply", "no more bytes", in_quotes(runs.front().bytes), line);
  other->tick = runs.front().tick;
  return other;
}

Replayer::Result Replayer::compare_hash(const std::string& expected) {
  if (compared_ != Compared::kAll) return std::nullopt;
  const std::string found = hasher_.hash(cell_);
  return found == expected ? std::nullopt : difference("digest of the state", expected, found);
}

/// The transport of the recording had sent all but these bytes of the line's outbox.
Replayer::Result Replayer::leave_unsent(LineId line, std::size_t unsent) {
  const std::size_t waiting = cell_.find_line(line)->outbox().size();
  if (unsent > waiting)
    return difference("unsent bytes", std::to_string(unsent), std::to_string(waiting), line);
  cell_.sent({line, waiting - unsent});
  return std::nullopt;
}

}  // namespace xr3
