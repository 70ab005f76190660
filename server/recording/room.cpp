#include "server/recording/room.hpp"

namespace xr3 {

std::string RecordingRoom::refusal(std::uint64_t bytes) const {
  constexpr std::uint64_t kMebibyte = 1U << 20U;
  if (taken_ + bytes <= max_bytes_) return {};
  return "the recordings of this run together have reached their maximum of " +
         std::to_string(max_bytes_ / kMebibyte) + " MiB (--record-total)";
}

}  // namespace xr3
