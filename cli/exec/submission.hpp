// Checks of the paths of submissions, which are untrusted.
#pragma once

#include <filesystem>
#include <string>

namespace xr3 {

/// The reason to refuse a submission: it is a symbolic link, or contains one that leads out of it,
/// which could submit another author's program; or it is a FIFO, socket or device. Empty if it is
/// acceptable.
std::string why_refused(const std::filesystem::path& submission);

}  // namespace xr3
