#include "server/net/standard_input.hpp"

#include <sys/stat.h>
#include <unistd.h>

namespace xr3 {
namespace {

/// Whether standard input is a file or a device such as /dev/null, for which epoll does not wait.
bool is_always_ready() {
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0) return true;
  const bool is_device = S_ISCHR(status.st_mode) && ::isatty(STDIN_FILENO) == 0;
  return S_ISREG(status.st_mode) || S_ISDIR(status.st_mode) || is_device;
}

}  // namespace

StandardInput::StandardInput(asio::io_context& context) : input_(context) {
  if (!is_always_ready()) input_.assign(::dup(STDIN_FILENO));
}

asio::awaitable<std::string_view> StandardInput::read() {
  if (input_.is_open()) {
    const auto [cancelled] =
        co_await input_.async_wait(asio::posix::stream_descriptor::wait_read, kAwait);
    if (cancelled) co_return std::string_view{};
  }
  const ssize_t size = ::read(STDIN_FILENO, buffer_.data(), buffer_.size());
  co_return size <= 0 ? std::string_view{}
                      : std::string_view(buffer_.data(), static_cast<std::size_t>(size));
}

}  // namespace xr3
