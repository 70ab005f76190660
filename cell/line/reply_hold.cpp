#include "cell/line/reply_hold.hpp"

#include <cassert>
#include <utility>

namespace xr3 {

void ReplyHold::add(std::string_view reply, const wire::Meaning& meaning) {
  assert(is_on_);
  const std::size_t from = held_.bytes.size();
  held_.bytes += reply;
  const std::size_t to = held_.bytes.size();
  if (held_.items.size() < kMaxItems) {
    held_.items.push_back({from, to, meaning});
    return;
  }
  if (held_.items.size() == kMaxItems) held_.items.push_back({from, from, wire::MoreAnswers{0}});
  wire::Item& rest = held_.items.back();
  ++std::get<wire::MoreAnswers>(rest.what).count;
  rest.to = to;
}

HeldReplies ReplyHold::end() {
  is_on_ = false;
  return std::exchange(held_, {});
}

}  // namespace xr3
