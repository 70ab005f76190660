// Standard input for coroutines: a terminal, a pipe, a file or a device. Its file
// description stays blocking, because other processes may share it.
#pragma once

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <string_view>

#include "server/net/asio.hpp"

namespace xr3 {

class StandardInput {
 public:
  explicit StandardInput(asio::io_context& context);

  /// The next bytes, valid until the next read. Empty at the end.
  asio::awaitable<std::string_view> read();

 private:
  asio::posix::stream_descriptor input_;  ///< not open if reading never waits
  std::array<char, 4096> buffer_{};
};

}  // namespace xr3
