#include "server/http/cell_bodies.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace xr3::http {
namespace {

class CellBodiesTest : public testing::TestWithParam<std::size_t> {
 protected:
  static monitor::Message message(char filler) {
    return std::make_shared<const std::string>(GetParam(), filler);
  }

  void ask(const monitor::Message& of) {
    asio::co_spawn(
        io_,
        [this, of]() -> asio::awaitable<void> { answers_.push_back(co_await bodies_.state(of)); },
        asio::detached);
  }
  /// The answers to all that was asked since the last call, in order.
  std::vector<Body> answers() {
    io_.restart();
    io_.run();
    return std::exchange(answers_, {});
  }

 private:
  asio::io_context io_;
  Worker worker_;
  CellBodies bodies_{io_, worker_};
  std::vector<Body> answers_;
};

TEST_P(CellBodiesTest, HasTheTextOfTheMessage) {
  const monitor::Message now = message('x');
  ask(now);
  const std::vector<Body> all = answers();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].bytes(), *now + "\n");
}

TEST_P(CellBodiesTest, RequestsForOneStateShareABody) {
  const monitor::Message now = message('x');
  ask(now);
  ask(now);
  std::vector<Body> all = answers();
  ask(now);
  all.push_back(answers().at(0));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].bytes().data(), all[1].bytes().data());
  EXPECT_EQ(all[0].bytes().data(), all[2].bytes().data());
}

TEST_P(CellBodiesTest, EachRequestGetsItsOwnState) {
  for (const char each : {'a', 'b', 'c'}) ask(message(each));
  const std::vector<Body> all = answers();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].bytes().front(), 'a');
  EXPECT_EQ(all[1].bytes().front(), 'b');
  EXPECT_EQ(all[2].bytes().front(), 'c');
}

INSTANTIATE_TEST_SUITE_P(ShortAndLong, CellBodiesTest,
                         testing::Values(100, CellBodies::kMaxCopiedAtOnce + 1));

}  // namespace
}  // namespace xr3::http
