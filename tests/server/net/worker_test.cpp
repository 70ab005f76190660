#include "server/net/worker.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/http/body_maker.hpp"

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

std::ptrdiff_t threads() {
  const std::filesystem::directory_iterator all("/proc/self/task");
  return std::distance(begin(all), end(all));
}

TEST(Worker, StartsItsThreadWithTheFirstWork) {
  asio::io_context io;
  const std::ptrdiff_t before = threads();
  Worker worker;
  EXPECT_EQ(threads(), before);
  for (int i = 0; i < 2; ++i)
    asio::co_spawn(
        io, [&]() -> asio::awaitable<void> { co_await worker.run([] { return 0; }); },
        asio::detached);
  io.run();
  EXPECT_EQ(threads(), before + 1);
}

/// While it exists, no thread can be started: its stack would be larger than the address space.
class NoThreads {
 public:
  NoThreads() {
    ::pthread_getattr_default_np(&usual_);
    pthread_attr_t huge;
    ::pthread_attr_init(&huge);
    ::pthread_attr_setstacksize(&huge, std::size_t{1} << 50);
    ::pthread_setattr_default_np(&huge);
    ::pthread_attr_destroy(&huge);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;
  ~NoThreads() {
    ::pthread_setattr_default_np(&usual_);
    ::pthread_attr_destroy(&usual_);
  }

 private:
  pthread_attr_t usual_{};
};

TEST(Worker, WorksInTheLoopIfNoThreadCanBeStarted) {
  asio::io_context io;
  const std::ptrdiff_t before = threads();
  Worker worker;
  const auto work = [&]() -> asio::awaitable<void> {
    const auto where = co_await worker.run([] { return std::this_thread::get_id(); });
    EXPECT_EQ(where, std::this_thread::get_id());
  };
  {
    const NoThreads none;
    asio::co_spawn(io, work(), asio::detached);
    io.run();
  }
  EXPECT_EQ(threads(), before);
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

TEST(BodyMaker, MakesABodyOnceForAllThatWait) {
  asio::io_context io;
  Worker worker;
  http::BodyMaker<int> maker(io, worker);
  int key = 0;
  int made = 0;
  std::vector<std::string> bodies;
  const auto request = [&]() -> asio::awaitable<void> {
    const http::Body body = co_await maker.get([&]() -> http::BodyMaker<int>::Recipe {
      ++made;
      return {++key, [now = key] { return std::to_string(now); }};
    });
    bodies.emplace_back(body.bytes());
  };
  for (int i = 0; i < 5; ++i) asio::co_spawn(io, request(), asio::detached);
  io.run();
  EXPECT_EQ(made, 2) << "the one that began first, and one for all that came later";
  EXPECT_EQ(bodies, (std::vector<std::string>{"1", "2", "2", "2", "2"}));
}

TEST(BodyMaker, KeepsABodyUntilItsKeyChanges) {
  asio::io_context io;
  Worker worker;
  http::BodyMaker<int> maker(io, worker);
  int made = 0;
  const auto get = [&](int key) {
    asio::co_spawn(
        io,
        [&, key]() -> asio::awaitable<void> {
          co_await maker.get([&, key]() -> http::BodyMaker<int>::Recipe {
            return {key, [&made] { return std::to_string(++made); }};
          });
        },
        asio::detached);
    io.restart();
    io.run();
  };
  for (const int key : {7, 7, 8, 8, 7}) get(key);
  EXPECT_EQ(made, 3);
}

}  // namespace
}  // namespace xr3
