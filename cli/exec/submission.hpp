// The paths of submissions, which are untrusted: checks, the file that is run, and all files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace xr3 {

/// The reason to refuse a submission: it is a symbolic link, or contains one that leads out of it,
/// which could submit another author's program; or it is a FIFO, socket or device. Empty if it is
/// acceptable.
std::string why_refused(const std::filesystem::path& submission);

/// Whether a file or folder is hidden, or made by Python: no submission, and no part of one.
bool is_by_the_way(const std::filesystem::path& path);

/// A line for each file of the submission, sorted: SHA-256, or the time of the last change if it is
/// large; size and path. Differs from an earlier text if the submission has changed. Without files
/// that are by the way. If why_refused() refuses the submission, the reason.
std::string files_of(const std::filesystem::path& submission);

/// The file that is run: the submission itself, or of a folder the file `main` in it, or else the
/// only file in it with the same extension; nullopt if there is neither. If `main` is empty, the
/// submission itself, also a folder. Call it for submissions that why_refused() accepts.
std::optional<std::filesystem::path> main_of(const std::filesystem::path& submission,
                                             const std::string& main);

}  // namespace xr3
