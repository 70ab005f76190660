#include "server/service/wrong_tokens.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace xr3 {
namespace {

constexpr WallNs kTokenLogEvery = 1'000'000'000;
constexpr WallNs kBetweenAnswers = 1'000'000'000 / WrongTokens::kWrongTokensPerSecond;

}  // namespace

asio::awaitable<void> WrongTokens::delay() {
  note();
  asio::steady_timer timer(io_, as_time_point(answer_at(wall_now())));
  co_await timer.async_wait(kAwait);
}

WallNs WrongTokens::answer_at(WallNs now) {
  const WallNs earliest = now + std::chrono::nanoseconds(kWrongTokenDelay).count();
  const WallNs answer = std::max(earliest, next_answer_);
  next_answer_ = answer + kBetweenAnswers;
  return answer;
}

// At most one message a second, however many clients try.
void WrongTokens::note() {
  ++count_;
  const WallNs now = wall_now();
  if (now < next_log_) return;
  next_log_ = now + kTokenLogEvery;
  spdlog::warn("monitor: a client gave a wrong token; {} since the start", count_);
}

}  // namespace xr3
