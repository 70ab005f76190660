// The paths of submissions, which are untrusted: checks, and the file that is run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace xr3 {

/// The reason to refuse a submission: it is a symbolic link, or contains one that leads out of it,
/// which could submit another author's program; or it is a FIFO, socket or device. Empty if it is
/// acceptable.
std::string why_refused(const std::filesystem::path& submission);

/// The file that is run: the submission itself, or of a folder the file `main` in it, or else the
/// only file in it with the same extension; nullopt if there is neither. If `main` is empty, the
/// submission itself, also a folder. Call it for submissions that why_refused() accepts.
std::optional<std::filesystem::path> main_of(const std::filesystem::path& submission,
                                             const std::string& main);

}  // namespace xr3
