#include "server/pty/stream.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace xr3 {

PtyStream::PtyStream(Descriptor line, PtyShared& shared, std::uint64_t& progress)
    : RobotSocket(std::move(line)), shared_(shared), progress_(progress) {
  const std::scoped_lock use(shared_.use);
  reach_changes();
}

void PtyStream::reach_changes() {
  auto& changes = shared_.changes;
  for (; !changes.empty() && changes.front().offset <= offset_; changes.pop_front())
    modes_ = changes.front().modes;
}

// The lock keeps the thread from adding a change, and so from writing the bytes behind it, between
// the look at the changes and the read.
std::size_t PtyStream::read(std::span<char> into) {
  const std::scoped_lock use(shared_.use);
  reach_changes();
  const std::uint64_t alike = shared_.changes.empty() ? std::numeric_limits<std::uint64_t>::max()
                                                      : shared_.changes.front().offset - offset_;
  const std::size_t most = std::min<std::uint64_t>(into.size(), alike);
  const std::size_t count = RobotSocket::read(into.first(most));
  offset_ += count;
  set_has_more(count == alike);
  if (count > 0) ++progress_;
  return count;
}

std::optional<LineSettings> PtyStream::changed_settings(LineId line) {
  if (modes_ == taken_ || modes_.baud == 0) return std::nullopt;
  taken_ = modes_;
  return LineSettings{line, {modes_.baud, std::nullopt}, modes_.is_cooked};
}

}  // namespace xr3
