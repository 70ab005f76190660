// The room that the recordings of all cells in a run of the server share.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "server/net/wall_clock.hpp"

namespace xr3 {

/// The bytes of a file system; a `size` of 0 if unknown.
struct DiskSpace {
  std::uint64_t size = 0;
  std::uint64_t free = 0;  ///< for this user
};
/// The space of the file system of an existing or future file.
DiskSpace disk_space(const std::string& path);

class RecordingRoom {
 public:
  using SpaceOf = std::function<DiskSpace(const std::string& path)>;

  /// The space that recordings leave free: 512 MiB, or 5 % of the file system if that is less.
  static constexpr std::uint64_t kFreeMib = 512;
  static constexpr std::uint64_t kFreePercent = 5;

  static constexpr WallNs kLookEvery = 1'000'000'000;

  /// `max_bytes`: total of all recordings. `look_every`: minimum time between two calls of
  /// `space_of`, which may take long in a network.
  explicit RecordingRoom(std::uint64_t max_bytes, SpaceOf space_of = disk_space,
                         WallNs look_every = kLookEvery)
      : max_bytes_(max_bytes), space_of_(std::move(space_of)), look_every_(look_every) {}
  RecordingRoom(const RecordingRoom&) = delete;
  RecordingRoom& operator=(const RecordingRoom&) = delete;

  /// The reason why a recording cannot have more bytes; empty if it can.
  std::string refusal(std::uint64_t bytes) const;
  /// The reason why files beside this one should not grow; empty if they may.
  const std::string& shortage(const std::string& path, WallNs now);
  /// The bytes that recordings in this folder, or in this file, may still have.
  std::uint64_t left(const std::string& path, WallNs now);
  /// Takes bytes from the room. Precondition: refusal(bytes) is empty.
  void take(std::uint64_t bytes) {
    assert(refusal(bytes).empty());
    taken_ += bytes;
  }

 private:
  void look(const std::string& path, WallNs now);
  std::uint64_t kept() const;

  std::uint64_t max_bytes_;
  SpaceOf space_of_;
  WallNs look_every_;
  WallNs next_look_ = 0;
  DiskSpace space_;
  std::string shortage_;
  std::uint64_t taken_ = 0;
};

}  // namespace xr3
