#include "cli/exec/pool.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>

namespace xr3 {
namespace {

constexpr WallNs kLong = 100'000'000'000;

std::vector<std::optional<std::string>> results(
    WallNs limit, const std::function<std::string(std::size_t)>& task) {
  return in_processes(3, 2, limit, task, [](std::size_t) {});
}

TEST(Pool, ReturnsTheResultsInOrder) {
  const auto all = results(kLong, [](std::size_t index) { return std::to_string(index); });
  EXPECT_EQ(all, (std::vector<std::optional<std::string>>{"0", "1", "2"}));
}

TEST(Pool, AProcessThatFailsHarmsNoOther) {
  const auto all = results(0, [](std::size_t index) {
    if (index == 0) ::raise(SIGKILL);
    if (index == 1) throw std::runtime_error("no");
    return std::string("good");
  });
  EXPECT_EQ(all, (std::vector<std::optional<std::string>>{std::nullopt, std::nullopt, "good"}));
}

TEST(Pool, AProcessThatIsStoppedIsEnded) {
  const auto all = results(1'000'000'000, [](std::size_t index) {
    if (index == 1) ::raise(SIGSTOP);
    return std::string("good");
  });
  EXPECT_EQ(all, (std::vector<std::optional<std::string>>{"good", std::nullopt, "good"}));
}

TEST(Pool, ASignalEndsTheTasksThatAreUnderWayAndLeavesTheResults) {
  StopSignals stop;
  std::vector<std::size_t> done;
  const auto all = in_processes(
      4, 2, kLong,
      [](std::size_t index) {
        while (index > 0) ::pause();
        return std::string("good");
      },
      [&](std::size_t index) {
        done.push_back(index);
        ::raise(SIGINT);
      },
      &stop);
  EXPECT_EQ(done, std::vector<std::size_t>{0});
  EXPECT_EQ(all, (std::vector<std::optional<std::string>>{"good", {}, {}, {}}));
  EXPECT_FALSE(stop.take()) << "a further signal has its usual effect";
}

}  // namespace
}  // namespace xr3
