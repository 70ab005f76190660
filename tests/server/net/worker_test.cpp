#include "server/net/worker.hpp"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <stdexcept>
#include <thread>

namespace xr3 {
namespace {

TEST(Worker, WorksInAnotherThreadAndResumesInTheLoop) {
  asio::io_context io;
  Worker worker;
  std::thread::id of_work;
  std::thread::id of_rest;
  asio::co_spawn(
      io,
      [&]() -> asio::awaitable<void> {
        of_work = co_await worker.run([] { return std::this_thread::get_id(); });
        of_rest = std::this_thread::get_id();
      },
      asio::detached);
  io.run();
  EXPECT_NE(of_work, std::this_thread::get_id());
  EXPECT_EQ(of_rest, std::this_thread::get_id());
}

TEST(Worker, PassesExceptionsOn) {
  asio::io_context io;
  Worker worker;
  bool is_caught = false;
  asio::co_spawn(
      io,
      [&]() -> asio::awaitable<void> {
        try {
          co_await worker.run([]() -> int { throw std::runtime_error("no"); });
        } catch (const std::runtime_error&) {
          is_caught = true;
        }
      },
      asio::detached);
  io.run();
  EXPECT_TRUE(is_caught);
}

}  // namespace
}  // namespace xr3
