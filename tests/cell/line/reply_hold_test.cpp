#include "cell/line/reply_hold.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

const wire::Answered kAnswer{QueryError{'E'}, ErrorMagnitude{0}};

TEST(ReplyHold, ItemsCoverAllBytesInOrder) {
  ReplyHold hold;
  hold.begin();
  std::string bytes;
  for (std::size_t i = 0; i < ReplyHold::kMaxItems + 10; ++i) {
    const std::string reply(1 + i % 3, static_cast<char>(i));
    hold.add(reply, kAnswer);
    bytes += reply;
    EXPECT_EQ(hold.size(), bytes.size());
  }
  const HeldReplies held = hold.end();
  EXPECT_EQ(held.bytes, bytes);
  ASSERT_EQ(held.items.size(), ReplyHold::kMaxItems + 1);
  std::uint64_t last = 0;
  for (const wire::Item& item : held.items) {
    EXPECT_EQ(item.from, last);
    last = item.to;
  }
  EXPECT_EQ(last, bytes.size());
  EXPECT_EQ(std::get<wire::MoreAnswers>(held.items.back().what).count, 10U);
}

TEST(ReplyHold, EndsEmpty) {
  ReplyHold hold;
  hold.begin();
  hold.add("ab", kAnswer);
  hold.end();
  EXPECT_FALSE(hold.is_on());
  EXPECT_EQ(hold.size(), 0U);
  EXPECT_EQ(hold.end().bytes, "");
}

TEST(ReplyHold, IsFullAt64KiB) {
  ReplyHold hold;
  hold.begin();
  hold.add(std::string(ReplyHold::kFull - 1, 'x'), kAnswer);
  EXPECT_FALSE(hold.is_full());
  hold.add("xxx", kAnswer);
  EXPECT_TRUE(hold.is_full());
  hold.discard();
  EXPECT_FALSE(hold.is_full());
  EXPECT_TRUE(hold.is_on());
}

}  // namespace
}  // namespace xr3
