// Writes files atomically: a complete draft in the same folder is renamed to the file's name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "server/files/data_files.hpp"

namespace xr3 {

/// The treatment of an existing file.
enum class Existing : std::uint8_t { kKeep, kReplace };

/// Writes the text to a file. Before the rename it reads the draft back and passes it to `check`,
/// which may throw. Returns false if the file exists and `existing` is kKeep. Throws FileError.
/// After false or an exception nothing is changed. Follows symbolic links; keeps the permissions of
/// the file.
bool write_file_atomically(const std::filesystem::path& path, const std::string& text,
                           Existing existing, const std::function<void(const DataFile&)>& check);

/// The same, over an existing file and without a check.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace xr3
