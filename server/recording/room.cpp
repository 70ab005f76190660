#include "server/recording/room.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <filesystem>

namespace xr3 {
namespace {

constexpr std::uint64_t kPercent = 100;

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20U) + " MiB"; }

}  // namespace

DiskSpace disk_space(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  struct statvfs found {};
  if (::statvfs(folder.empty() ? "." : folder.c_str(), &found) != 0) return {};
  return {std::uint64_t{found.f_blocks} * found.f_frsize,
          std::uint64_t{found.f_bavail} * found.f_frsize};
}

std::string RecordingRoom::refusal(std::uint64_t bytes) const {
  if (taken_ + bytes <= max_bytes_) return {};
  return "the recordings of this run together have reached their maximum of " +
         mebibytes(max_bytes_) + " (--record-total)";
}

const std::string& RecordingRoom::shortage(const std::string& path, WallNs now) {
  look(path, now);
  return shortage_;
}

std::uint64_t RecordingRoom::left(const std::string& path, WallNs now) {
  look((std::filesystem::path(path) / "").string(), now);
  const std::uint64_t of_run = max_bytes_ - taken_;
  const std::uint64_t of_disk = space_.free - std::min(space_.free, kept());
  return space_.size == 0 ? of_run : std::min(of_run, of_disk);
}

void RecordingRoom::look(const std::string& path, WallNs now) {
  if (now < next_look_) return;
  next_look_ = now + look_every_;
  space_ = space_of_(path);
  shortage_.clear();
  if (space_.free < kept())
    shortage_ = "its disk has only " + mebibytes(space_.free) + " free, and recordings leave " +
                mebibytes(kept());
}

std::uint64_t RecordingRoom::kept() const {
  return std::min(kFreeMib << 20U, space_.size / kPercent * kFreePercent);
}

}  // namespace xr3
