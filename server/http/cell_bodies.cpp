#include "server/http/cell_bodies.hpp"

#include <string>
#include <utility>

namespace xr3::http {

asio::awaitable<Body> CellBodies::state(monitor::Message message) {
  co_await copying_.until_free();
  if (state_of_ == message) co_return state_;
  const auto copy = [message] { return *message + "\n"; };
  if (message->size() <= kMaxCopiedAtOnce) {
    state_ = Body(copy());
  } else {
    const Exclusive::Hold hold(copying_);
    std::string text = co_await worker_.run(copy);
    state_ = Body(std::move(text));
  }
  state_of_ = std::move(message);
  co_return state_;
}

}  // namespace xr3::http
