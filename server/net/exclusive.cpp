#include "server/net/exclusive.hpp"

namespace xr3 {

asio::awaitable<void> Exclusive::until_free() {
  while (is_held_) co_await freed_.async_wait(kAwait);
}

}  // namespace xr3
