// Paths of submissions, which other people have chosen.
#pragma once

#include <filesystem>
#include <string>

namespace xr3 {

/// The reason to refuse a submission: it is a symbolic link, or has one that leads out of it: such
/// a program would be that of somebody else; or it is a FIFO, socket or device. Empty if it is
/// good.
std::string why_refused(const std::filesystem::path& submission);

}  // namespace xr3
