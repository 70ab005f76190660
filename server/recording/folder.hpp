// The folder in which several cells are recorded: in it a folder for each cell, with its name, and
// there a file for each time that it began, named after that time in UTC. All are for this user
// alone.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

/// Makes the folder unless it exists. Throws FileError.
void make_recording_folder(const std::string& folder);

/// The path of a new recording of a cell: FOLDER/NAME/2026-11-23T15-29-49Z.xr3rec, or …Z-2.xr3rec
/// if that exists. Makes the folder of the cell. Throws FileError.
std::string new_recording_path(const std::string& folder, const std::string& cell,
                               std::chrono::system_clock::time_point begin);

/// Whether a file is named as new_recording_path() does it.
bool is_recording_name(std::string_view name);

/// The path of the recording of a cell that has begun last; nullopt if it has none.
std::optional<std::string> newest_recording(const std::string& folder, const std::string& cell);

/// The folders of the cells.
std::vector<std::string> folders_of_cells(const std::string& folder);

/// Deletes the recordings in the folder of a cell that were written last before `oldest`, then the
/// folder if it is empty. Keeps those that a server writes now, those that `is_kept` names by their
/// path, and every file that new_recording_path() has not named. Returns the number of recordings
/// that are gone.
std::size_t delete_old_recordings(const std::string& of_cell,
                                  std::chrono::system_clock::time_point oldest,
                                  const std::function<bool(const std::string& path)>& is_kept);

}  // namespace xr3
