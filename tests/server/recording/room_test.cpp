// The free space that recordings leave, on small and large disks.
#include "server/recording/room.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace xr3 {
namespace {

constexpr std::uint64_t kGiB = 1U << 30U;

bool is_short(DiskSpace space) {
  return !RecordingRoom(0, [=](const std::string&) { return space; }).shortage("a", 0).empty();
}

TEST(RecordingRoomTest, LeavesTheLesserOf512MiBAnd5Percent) {
  EXPECT_FALSE(is_short({1000 * kGiB, kGiB / 2}));
  EXPECT_TRUE(is_short({1000 * kGiB, kGiB / 2 - 1}));
  EXPECT_FALSE(is_short({2000, 100}));
  EXPECT_TRUE(is_short({2000, 99}));
  EXPECT_FALSE(is_short({0, 0})) << "unknown";
}

TEST(RecordingRoomTest, LooksOnceASecond) {
  int looks = 0;
  RecordingRoom room(0, [&](const std::string&) {
    return DiskSpace{2000, ++looks == 1 ? 99U : 100U};
  });
  EXPECT_NE(room.shortage("a", 0), "");
  EXPECT_NE(room.shortage("b", 999'999'999), "");
  EXPECT_EQ(room.shortage("a", 1'000'000'000), "");
  EXPECT_EQ(looks, 2);
}

TEST(RecordingRoomTest, HasWhatIsLeftOfTheRunAndOfTheDisk) {
  DiskSpace space{2000 * kGiB, kGiB};
  RecordingRoom room(
      kGiB, [&](const std::string&) { return space; }, 1);
  EXPECT_EQ(room.left("a", 0), kGiB / 2) << "of the disk";
  room.take(kGiB * 3 / 4);
  EXPECT_EQ(room.left("a", 1), kGiB / 4) << "of the run";
  space.free = 0;
  EXPECT_EQ(room.left("a", 2), 0U);
  space = {};
  EXPECT_EQ(room.left("a", 3), kGiB / 4) << "unknown";
}

TEST(RecordingRoomTest, KnowsTheSpaceOfAFileThatIsToBeMade) {
  const std::filesystem::space_info now = std::filesystem::space(".");
  EXPECT_EQ(disk_space("some.xr3rec").size, now.capacity);
  EXPECT_EQ(disk_space("/none/some.xr3rec").size, 0U);
}

}  // namespace
}  // namespace xr3
