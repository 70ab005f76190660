#include "server/pty/signal.hpp"

#include <sys/eventfd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <string>

#include "server/files/data_files.hpp"

namespace xr3 {

Signal::Signal() : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!event_.is_open())
    throw FileError(std::string("a signal cannot be made: ") + std::strerror(errno));
}

void Signal::give() const {
  [[maybe_unused]] const int error = ::eventfd_write(event_.get(), 1);
  assert(error == 0);
}

void Signal::take() const {
  ::eventfd_t count = 0;
  static_cast<void>(::eventfd_read(event_.get(), &count));  // not given: nothing to take
}

}  // namespace xr3
