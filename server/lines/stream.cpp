#include "server/lines/stream.hpp"

#include <sys/ioctl.h>

#include <cassert>

namespace xr3 {

std::size_t LineStream::unread_bytes() const {
  assert(is_open());
  int count = 0;
  return ::ioctl(descriptor(), FIONREAD, &count) == 0 ? static_cast<std::size_t>(count) : 0;
}

}  // namespace xr3
