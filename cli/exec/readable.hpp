// The files of the judge that a program in the sandbox can read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/exec/program_user.hpp"

namespace xr3 {

/// A file or folder of this machine, and its place in the sandbox.
struct Binding {
  std::filesystem::path from;
  std::filesystem::path to;
};

/// Maximum number and size of files that are copied for another user.
inline constexpr std::size_t kMaxCopiedFiles = 10'000;
inline constexpr std::uintmax_t kMaxCopiedBytes = std::uintmax_t{256} << 20U;

/// Binds a path to its place. For another user it is copied to `copy` if not every user may read
/// all of it. Throws FileError.
Binding readable_by(const std::optional<ProgramUser>& user, const std::filesystem::path& from,
                    const std::filesystem::path& to, const std::filesystem::path& copy);

}  // namespace xr3
