// The wrong tokens of all clients: counts and logs them, and delays their answers, so that trying
// many takes long. A right token is never delayed.
#pragma once

#include <chrono>
#include <cstdint>

#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class WrongTokens {
 public:
  /// The least time until the answer.
  static constexpr std::chrono::milliseconds kWrongTokenDelay{200};
  /// The most answers in a second, all clients together.
  static constexpr int kWrongTokensPerSecond = 20;

  explicit WrongTokens(asio::io_context& io) : io_(io) {}

  /// Counts a wrong token, and resumes when it is to be answered. Each client waits for one answer
  /// at a time, so the number of connections bounds the number that waits.
  asio::awaitable<void> delay();
  std::uint64_t count() const { return count_; }

  /// The time of the answer to a wrong token that arrives now, after those of all before.
  WallNs answer_at(WallNs now);

 private:
  void note();

  asio::io_context& io_;
  std::uint64_t count_ = 0;
  WallNs next_answer_ = 0;  ///< earliest time of the next answer
  WallNs next_log_ = 0;     ///< earliest time of the next message
};

}  // namespace xr3
