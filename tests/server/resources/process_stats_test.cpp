// Tests the statistics of the process.
#include "server/resources/process_stats.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

namespace xr3 {
namespace {

TEST(ProcessStats, CountsOpenDescriptors) {
  const auto before = process_stats();
  const int one = ::open("/dev/null", O_RDONLY);
  const int two = ::open("/dev/null", O_RDONLY);
  const auto with_two = process_stats();
  ::close(one);
  ::close(two);
  ASSERT_TRUE(before.open_descriptors && with_two.open_descriptors);
  EXPECT_EQ(*with_two.open_descriptors, *before.open_descriptors + 2);
  EXPECT_EQ(process_stats().open_descriptors, before.open_descriptors);
  EXPECT_GT(*before.max_descriptors, *before.open_descriptors);
}

TEST(ProcessStats, MeasuresResidentMemory) {
  constexpr std::size_t kBytes = std::size_t{64} * 1024 * 1024;
  const auto before = process_stats().resident_bytes;
  const std::vector<char> touched(kBytes, 'x');
  const auto after = process_stats().resident_bytes;
  ASSERT_TRUE(before && after);
  EXPECT_GT(*after, *before + kBytes / 2);
  EXPECT_LT(*after, *before + 2 * kBytes);
}

TEST(ProcessStats, MeasuresProcessorTime) {
  const auto before = process_stats().cpu_s;
  ASSERT_TRUE(before);
  while (process_stats().cpu_s < *before + 0.02) {
  }
}

}  // namespace
}  // namespace xr3
