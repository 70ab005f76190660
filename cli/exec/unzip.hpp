// Unpacks zip archives, which are untrusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace xr3 {

/// Maximum of an archive.
inline constexpr std::size_t kMaxZipFiles = 1000;
inline constexpr std::uint64_t kMaxZipBytes = std::uint64_t{64} << 20U;

/// Unpacks a zip archive into a folder, which is made. Links become files, and a name that leads
/// out of the folder is refused. Throws FileError, also for an archive that is damaged, encrypted
/// or too large.
void unzip(const std::filesystem::path& archive, const std::filesystem::path& folder);

}  // namespace xr3
