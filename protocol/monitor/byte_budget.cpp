#include "protocol/monitor/byte_budget.hpp"

#include <cassert>

namespace xr3::monitor {

void ByteBudget::set_bytes(Account& member, std::size_t before, std::size_t now) {
  if (before > 0) by_size_.erase({before, &member});
  if (now > 0) by_size_.emplace(now, &member);
  assert(used_bytes_ >= before);
  used_bytes_ = used_bytes_ - before + now;
}

/// Shrinks members that have more than `wanted` until `more` bytes are free.
bool ByteBudget::make_room(const Account& member, std::size_t more, std::size_t wanted) {
  while (used_bytes_ + more > max_bytes_) {
    if (by_size_.empty()) return false;
    const auto [most, greediest] = *by_size_.rbegin();
    if (greediest == &member || most <= wanted) return false;
    greediest->shrink();
    if (greediest->bytes() >= most) return false;  // nothing more can be freed
    set_bytes(*greediest, most, greediest->bytes());
  }
  return true;
}

bool ByteBudget::grant(Account& member, std::size_t wanted, Necessity necessity) {
  const std::size_t before = member.bytes();
  const bool has_room = wanted <= before || make_room(member, wanted - before, wanted);
  if (!has_room && necessity == Necessity::kUseful) return false;
  set_bytes(member, before, wanted);
  return true;
}

void ByteBudget::release(Account& member) { set_bytes(member, member.bytes(), 0); }

}  // namespace xr3::monitor
