// Writes data files whole or not at all: a draft beside the file takes its name when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "server/data_files.hpp"

namespace xr3 {

/// What becomes of a file that is there already.
enum class Existing : std::uint8_t { kKeep, kReplace };

/// Writes the text to a file. `check` gets the draft as it can be read again, before it takes its name.
/// False, and nothing is changed, if there is a file to be kept. Throws FileError, or what `check`
/// throws; nothing is changed then, either. A link is followed; the file's rights are kept.
bool write_whole_file(const std::filesystem::path& path, const std::string& text, Existing existing,
                      const std::function<void(const DataFile&)>& check);

}  // namespace xr3
