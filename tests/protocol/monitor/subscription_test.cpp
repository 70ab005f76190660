// Subscriptions: the latest frame in a slot, every message of a ring by a cursor, and the `lag` for
// a slow client.
#include "protocol/monitor/subscription.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/monitor/client.hpp"

namespace xr3::monitor {
namespace {

Message text(const std::string& words) { return std::make_shared<const std::string>(words); }

/// A frame with this content; its message is its seq.
Frame frame(std::int64_t seq, const std::string& content) {
  return {text(std::to_string(seq)), seq, content_id(content)};
}

Subscribe to(Channel channel, MilliHz max_millihz = kMaxMilliHz, bool on_change = true) {
  Subscribe wanted;
  wanted.selection.channel = channel;
  wanted.max_millihz = max_millihz;
  wanted.on_change = on_change;
  return wanted;
}

std::string shown(const Message& message) { return message ? *message : "-"; }

/// All messages sent at a frame.
std::vector<std::string> all(FrameSubscription& subscription, FrameNumber now) {
  std::vector<std::string> messages;
  while (const Message message = subscription.next_output(now)) messages.push_back(*message);
  return messages;
}

using Strings = std::vector<std::string>;

TEST(FrameSubscription, SendsOnlyChanges) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState), stats);
  sub.offer(frame(1, "a"), 0);
  EXPECT_EQ(all(sub, 0), Strings{"1"});
  sub.offer(frame(2, "a"), 1);
  EXPECT_EQ(all(sub, 1), Strings{});
  EXPECT_TRUE(sub.is_settled(frame(2, "a")));
  sub.offer(frame(3, "b"), 2);
  EXPECT_EQ(all(sub, 2), Strings{"3"});
  EXPECT_FALSE(sub.is_settled(frame(4, "c")));
}

TEST(FrameSubscription, AHeldOneSendsNothing) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState), stats);
  sub.offer(frame(1, "a"), 0);
  EXPECT_EQ(all(sub, 0), Strings{"1"});
  sub.offer(frame(2, "b"), 1);
  sub.hold();
  EXPECT_FALSE(sub.is_due(1'000'000));
  EXPECT_TRUE(sub.is_settled(frame(3, "c")));
  sub.offer(frame(3, "c"), 2);
  EXPECT_EQ(all(sub, 100), Strings{}) << "nor a lag";
  sub.release();
  EXPECT_TRUE(sub.is_due(3));
  EXPECT_FALSE(sub.is_settled(frame(4, "a")));
  sub.offer(frame(4, "a"), 3);
  EXPECT_EQ(all(sub, 3), Strings{"4"}) << "although the client had this content before";
}

TEST(MonitorClient, HoldsTheFramesOfOneCell) {
  Client client;
  client.follow_frames("one", to(Channel::kState)).offer(frame(1, "a"), 0);
  client.follow_frames("two", to(Channel::kState)).offer(frame(2, "b"), 0);
  client.hold_frames("one");
  client.follow_frames("one", to(Channel::kImage)).offer(frame(3, "c"), 0);
  EXPECT_EQ(shown(client.next_output(0)), "2");
  EXPECT_EQ(shown(client.next_output(0)), "-");
  client.release_frames("one");
  client.for_each_frame_subscription("one",
                                     [](FrameSubscription& each) { each.offer(frame(4, "d"), 1); });
  EXPECT_EQ(shown(client.next_output(1)), "4");
  EXPECT_EQ(shown(client.next_output(1)), "4");
  client.hold_frames("one");
  client.finish("one");
  EXPECT_FALSE(client.holds_frames("one")) << "a later cell may have this name";
}

TEST(FrameSubscription, WithoutOnChangeSendsEveryFrame) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState, kMaxMilliHz, false), stats);
  for (const FrameNumber now : {0, 1, 2}) {
    ASSERT_TRUE(sub.is_due(now));
    sub.offer(frame(1, "a"), now);
    EXPECT_EQ(all(sub, now), Strings{"1"});
    EXPECT_FALSE(sub.is_settled(frame(1, "a")));
  }
}

TEST(FrameSubscription, MaxHzSelectsFramesOfOneGrid) {
  const auto due_in_a_second = [](MilliHz max_millihz) {
    ChannelStats stats;
    FrameSubscription sub("main", to(Channel::kState, max_millihz), stats);
    int due = 0;
    for (FrameNumber now = 600; now < 660; ++now) {
      if (!sub.is_due(now)) continue;
      sub.offer(frame(now, std::to_string(now)), now);
      ++due;
    }
    return due;
  };
  EXPECT_EQ(due_in_a_second(60'000), 60);
  EXPECT_EQ(due_in_a_second(40'000), 40);
  EXPECT_EQ(due_in_a_second(30'000), 30);
  EXPECT_EQ(due_in_a_second(1'000), 1);
  EXPECT_EQ(due_in_a_second(100), 1);
}

TEST(FrameSubscription, ComparesUnchangedFramesAtMostTenTimesASecond) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState, 1'000), stats);
  sub.offer(frame(1, "a"), 600);
  all(sub, 600);
  EXPECT_EQ(sub.due(), 660) << "a message a second";
  sub.offer(frame(1, "a"), 660);
  EXPECT_EQ(sub.due(), 666) << "nothing was sent, so a change is sent soon";
  sub.offer(frame(2, "b"), 666);
  EXPECT_EQ(sub.due(), 720);
}

TEST(FrameSubscription, ComparesNoMoreOftenThanMaxHz) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState, 30'000), stats);
  sub.offer(frame(1, "a"), 600);
  all(sub, 600);
  sub.offer(frame(1, "a"), 602);
  EXPECT_FALSE(sub.is_due(603));
  EXPECT_TRUE(sub.is_due(604));
}

TEST(FrameSubscription, KeepsTheLatestFrameAndReportsTheRestAsLag) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kImage), stats);
  for (std::int64_t seq = 7; seq <= 12; ++seq) sub.offer(frame(seq, std::to_string(seq)), seq);
  EXPECT_EQ(all(sub, 12), (Strings{R"({"op":"lag","cell":"main","channel":"image","missed":5,)"
                                   R"("from_seq":7,"to_seq":11})",
                                   "12"}));
  EXPECT_EQ(stats.sent, 1U);
  EXPECT_EQ(stats.overwritten, 5U);
}

TEST(FrameSubscription, SendsAtMostOneLagASecond) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kImage), stats);
  sub.offer(frame(1, "1"), 0);
  sub.offer(frame(2, "2"), 1);
  EXPECT_EQ(all(sub, 1).size(), 2U);
  sub.offer(frame(3, "3"), 2);
  sub.offer(frame(4, "4"), 3);
  EXPECT_EQ(all(sub, 3), Strings{"4"});
  EXPECT_FALSE(sub.is_settled(frame(4, "4"))) << "a lag is still pending";
  EXPECT_FALSE(sub.has_output(60));
  EXPECT_TRUE(sub.has_output(61));
  EXPECT_NE(shown(sub.next_output(61)).find(R"("missed":1,"from_seq":3,"to_seq":3)"),
            std::string::npos);
  EXPECT_TRUE(sub.is_settled(frame(4, "4")));
}

TEST(FrameSubscription, SendsNothingIfTheFrameEqualsTheLastSent) {
  ChannelStats stats;
  FrameSubscription sub("main", to(Channel::kState), stats);
  sub.offer(frame(1, "a"), 0);
  all(sub, 0);
  sub.offer(frame(2, "b"), 1);
  sub.offer(frame(3, "a"), 2);
  EXPECT_EQ(all(sub, 2).size(), 1U) << "only the lag";
}

// --- Rings.

class FeedTest : public testing::Test {
 protected:
  void publish(int count) {
    for (int i = 0; i < count; ++i) ring.push() = static_cast<int>(ring.next());
  }
  FeedSubscription follow(std::optional<std::int64_t> since = {}) {
    Subscribe wanted = to(Channel::kEvent);
    wanted.since = since;
    return {"main", wanted, feed, stats};
  }
  static Strings all(FeedSubscription& sub) {
    Strings messages;
    while (const Message message = sub.next_output()) messages.push_back(*message);
    return messages;
  }

  ChannelStats stats;
  int made = 0;
  const std::shared_ptr<Ring<int>> feed =
      std::make_shared<Ring<int>>(4, [this](const int& value, std::int64_t seq) {
        ++made;
        return text(std::to_string(seq) + ":" + std::to_string(value));
      });
  Ring<int>& ring = *feed;
};

TEST_F(FeedTest, StartsNowOrAtASeq) {
  publish(3);
  FeedSubscription late = follow();
  FeedSubscription early = follow(2);
  EXPECT_FALSE(late.has_output());
  EXPECT_EQ(all(early), (Strings{"2:2", "3:3"}));
  publish(1);
  EXPECT_EQ(all(late), Strings{"4:4"});
  EXPECT_EQ(all(early), Strings{"4:4"});
}

TEST_F(FeedTest, ASlowSubscriberGetsOneLagAndContinues) {
  FeedSubscription sub = follow();
  publish(10);
  EXPECT_EQ(all(sub),
            (Strings{R"({"op":"lag","cell":"main","channel":"event","missed":6,"from_seq":1,)"
                     R"("to_seq":6})",
                     "7:7", "8:8", "9:9", "10:10"}));
}

TEST_F(FeedTest, AFutureSeqStartsNow) {
  FeedSubscription sub = follow(99);
  publish(1);
  EXPECT_EQ(all(sub), Strings{"1:1"});
}

TEST_F(FeedTest, FormatsMessagesOnceAndOnlyForSubscribers) {
  publish(4);
  EXPECT_EQ(made, 0);
  FeedSubscription one = follow(1);
  FeedSubscription other = follow(1);
  all(one);
  all(other);
  EXPECT_EQ(made, 4);
}

TEST_F(FeedTest, SendsAnswersFirstThenTheChannelsInTurn) {
  Client client;
  const auto lines = std::make_shared<Ring<int>>(
      4, [](const int&, std::int64_t seq) { return text("line" + std::to_string(seq)); });
  client.follow_feed("main", to(Channel::kEvent), feed);
  client.follow_feed("main", to(Channel::kLine), lines);
  publish(2);
  lines->push();
  lines->push();
  client.send(text("answer"));
  Strings messages;
  while (const Message message = client.next_output(0)) messages.push_back(*message);
  EXPECT_EQ(messages, (Strings{"answer", "1:1", "line1", "2:2", "line2"}));
}

TEST_F(FeedTest, TheLastMessagesOfAClosingCellAreSent) {
  Client client;
  client.follow_feed("main", to(Channel::kEvent), feed);
  client.follow_feed("other", to(Channel::kEvent), feed);
  publish(3);
  client.finish("main");
  EXPECT_FALSE(client.follows("main"));
  EXPECT_TRUE(client.follows("other"));
  EXPECT_EQ(client.subscriptions(), 1U);
  client.finish("other");
  Strings messages;
  while (const Message message = client.next_output(0)) messages.push_back(*message);
  EXPECT_EQ(messages, (Strings{"1:1", "2:2", "3:3", "1:1", "2:2", "3:3"}));
}

TEST_F(FeedTest, ASlowClientOfAClosingCellGetsALagAndTheLastMessage) {
  Client client;
  client.follow_feed("main", to(Channel::kEvent), feed);
  publish(20);
  client.finish("main");
  Strings messages;
  while (const Message message = client.next_output(0)) messages.push_back(*message);
  EXPECT_EQ(messages, (Strings{R"({"op":"lag","cell":"main","channel":"event","missed":19,)"
                               R"("from_seq":1,"to_seq":19})",
                               "20:20"}));
}

TEST_F(FeedTest, ADestroyedRingHasNoFurtherMessages) {
  auto own = std::make_shared<Ring<int>>(
      4, [](const int&, std::int64_t seq) { return text(std::to_string(seq)); });
  FeedSubscription sub("main", to(Channel::kEvent), own, stats);
  own->push();
  EXPECT_TRUE(sub.has_output());
  own.reset();
  EXPECT_FALSE(sub.has_output());
  EXPECT_EQ(sub.next_output(), nullptr);
}

TEST_F(FeedTest, AGetReturnsMessagesWithItsId) {
  const auto events = std::make_shared<Ring<int>>(4, [](const int&, std::int64_t seq) {
    return channel_message(Channel::kEvent, {"main", 0, seq, 0}, R"({"event":"x"})");
  });
  for (int i = 0; i < 3; ++i) events->push();
  Client client;
  Get get;
  get.selection.channel = Channel::kEvent;
  get.since = 2;
  client.replay(events, "main", get, std::int64_t{5});
  client.send(text("result"));
  events->push();  // too late for the reply
  Strings messages;
  while (const Message message = client.next_output(0)) messages.push_back(*message);
  const std::string head = R"({"op":"event","id":5,"cell":"main","epoch":0,"seq":)";
  EXPECT_EQ(messages, (Strings{head + R"(2,"tick":0,"event":"x"})",
                               head + R"(3,"tick":0,"event":"x"})", "result"}));
}

}  // namespace
}  // namespace xr3::monitor
