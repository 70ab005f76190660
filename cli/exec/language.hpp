// The command that starts a program of an exercise, by its language.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace xr3 {

/// The command for a program by the end of its name; else it is executable. One in C is compiled at
/// its start to the file `built`, with the headers of its folder and of the folder `headers`.
/// Throws FileError if it is neither.
std::vector<std::string> start_command(const std::filesystem::path& program,
                                       const std::string& built, const std::string& headers);

}  // namespace xr3
