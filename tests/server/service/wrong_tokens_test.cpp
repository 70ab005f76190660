// When wrong tokens are answered.
#include "server/service/wrong_tokens.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

TEST(WrongTokensTest, OneIsAnsweredAfterTheDelay) {
  asio::io_context io;
  WrongTokens tokens(io);
  EXPECT_EQ(tokens.answer_at(1000 * kMs), 1200 * kMs);
  EXPECT_EQ(tokens.answer_at(2000 * kMs), 2200 * kMs);
}

TEST(WrongTokensTest, ManyAreAnsweredOneAfterTheOther) {
  asio::io_context io;
  WrongTokens tokens(io);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(tokens.answer_at(0), (200 + i * 50) * kMs);
  EXPECT_EQ(tokens.answer_at(3000 * kMs), 3200 * kMs);
  EXPECT_EQ(tokens.answer_at(3000 * kMs), 3250 * kMs);
}

}  // namespace
}  // namespace xr3
