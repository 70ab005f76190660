// A Foxglove client of a cell, without a connection. The clock is manual.
#include "server/foxglove/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "server/foxglove/feeds.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kTimeZero("\x02\0\0\0\0\0\0\0\0", 9);

class FoxgloveSessionTest : public testing::Test, private MessageSink {
 protected:
  ~FoxgloveSessionTest() override {
    session_.reset();
    host_.turns.close();
    io_.restart();
    io_.run_for(10ms);
  }
  void pump() override {}

  void say(std::string_view message) {
    asio::co_spawn(io_, session_->handle(message), asio::detached);
    io_.restart();
    io_.poll();
  }
  /// The messages that wait, each as its bytes.
  std::vector<std::string> output() {
    std::vector<std::string> all;
    while (const auto message = session_->next_output())
      all.push_back(message->head + (message->text ? *message->text : ""));
    return all;
  }
  void step(Tick ticks) {
    at_->cell().apply(call::Call{call::Step{ticks}}, wall_now());
    at_->after_input();
    io_.restart();
    io_.run_for(100ms);  // several times the time between two frames
  }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  CellPtr at_ = host_.add(test::rhino()).shared_from_this();
  FoxgloveFeeds feeds_{io_};
  std::unique_ptr<FoxgloveSession> session_ = feeds_.open(static_cast<MessageSink&>(*this), at_);
};

TEST_F(FoxgloveSessionTest, DescribesItselfAndSendsOnlyTheTimeUnasked) {
  const std::vector<std::string> first = output();
  ASSERT_EQ(first.size(), 3U);
  EXPECT_TRUE(first[0].starts_with(R"({"op":"serverInfo")"));
  EXPECT_TRUE(first[1].starts_with(R"({"op":"advertise")"));
  EXPECT_EQ(first[2], kTimeZero);
  step(50);
  EXPECT_THAT(output(), ElementsAre(StartsWith("\x02")));
}

TEST_F(FoxgloveSessionTest, ASubscriptionBeginsWithTheLatestMessage) {
  output();
  say(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":6}]})");
  EXPECT_THAT(output(), ElementsAre(AllOf(StartsWith("\x01\x07"), HasSubstr(R"("tick":0)"))));
  step(50);
  step(50);
  const std::vector<std::string> later = output();
  ASSERT_EQ(later.size(), 2U) << "only the latest is sent to a client that was slow";
  EXPECT_TRUE(later[0].starts_with('\x02'));
  EXPECT_THAT(later[1], HasSubstr(R"("tick":100)"));
  say(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  step(50);
  EXPECT_THAT(output(), ElementsAre(StartsWith("\x02")));
}

TEST_F(FoxgloveSessionTest, AWrongRequestIsAnsweredByAStatus) {
  output();
  say("{");
  EXPECT_THAT(output(), ElementsAre(HasSubstr(R"("op":"status")")));
  say(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]})");
  EXPECT_THAT(output(), ElementsAre(HasSubstr("there is no channel 99")));
}

TEST_F(FoxgloveSessionTest, EndsAfterItsAnswers) {
  session_->end(monitor::CloseReason::kShutdown);
  EXPECT_EQ(output().size(), 2U);
  EXPECT_EQ(session_->close_reason(), monitor::CloseReason::kShutdown);
}

}  // namespace
}  // namespace xr3
