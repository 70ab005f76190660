// Exceptions that leave a loop or a session, wherever they are thrown.
#include "server/net/spawn.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

#include "cell/failure.hpp"

namespace xr3 {
namespace {

/// The message of the FatalFailure that leaves run(); empty if there is none.
std::string failure_of(asio::io_context& io) {
  try {
    io.run();
  } catch (const FatalFailure& failure) {
    return failure.what();
  }
  return "";
}

asio::awaitable<void> turn(asio::io_context& io) {
  asio::steady_timer timer(io, std::chrono::milliseconds(1));
  co_await timer.async_wait(kAwait);
}

asio::awaitable<void> fail_at_once() {
  throw std::bad_alloc();
  co_return;
}

asio::awaitable<void> fail_later(asio::io_context& io) {
  co_await turn(io);
  throw std::runtime_error("no luck");
}

TEST(FatalIfThrows, AnExceptionGetsTheNameOfTheInnermostPlace) {
  const auto message_of = [](auto work) -> std::string {
    try {
      fatal_if_throws("outer", [&] { fatal_if_throws("inner", work); });
    } catch (const FatalFailure& failure) {
      return failure.what();
    }
    return "";
  };
  EXPECT_EQ(message_of([] {}), "");
  EXPECT_EQ(message_of([] { throw std::runtime_error("no luck"); }), "inner: no luck");
  EXPECT_EQ(message_of([] { throw 7; }), "inner: an exception of unknown type");
  const std::string cut = message_of([] { throw std::runtime_error(std::string(1000, 'x')); });
  EXPECT_EQ(cut.size(), FatalFailure::kMaxBytes - 1);
}

TEST(Spawn, AnExceptionInALoopLeavesRun) {
  for (const bool is_later : {false, true}) {
    asio::io_context io{1};
    spawn_loop(io.get_executor(), "the loop", is_later ? fail_later(io) : fail_at_once());
    const std::string failure = failure_of(io);
    EXPECT_EQ(failure, is_later ? "the loop: no luck" : "the loop: std::bad_alloc");
  }
}

TEST(Spawn, ALoopMayReturn) {
  asio::io_context io{1};
  spawn_loop(io.get_executor(), "the loop", turn(io));
  EXPECT_EQ(failure_of(io), "");
}

TEST(Spawn, AnExceptionInASessionEndsThatSession) {
  asio::io_context io{1};
  int ended = 0;
  spawn_session(io.get_executor(), "monitor", fail_at_once(), [&] { ++ended; });
  spawn_session(io.get_executor(), "monitor", fail_later(io), [&] { ++ended; });
  spawn_session(io.get_executor(), "monitor", turn(io), [&] { ++ended; });
  EXPECT_EQ(failure_of(io), "");
  EXPECT_EQ(ended, 3);
}

asio::awaitable<void> fail_in_the_cell() {
  fatal_if_throws("the cell", [] { throw std::bad_alloc(); });
  co_return;
}

TEST(Spawn, AFatalFailureLeavesTheSession) {
  asio::io_context io{1};
  spawn_session(io.get_executor(), "monitor", fail_in_the_cell(), [] { ADD_FAILURE(); });
  EXPECT_EQ(failure_of(io), "monitor: the cell: std::bad_alloc");
}

}  // namespace
}  // namespace xr3
