// Finds robot and workcell files, by path or by the name of one installed with xr3, and reads them.
//
// The flow through the folder: a command line names a robot, a workcell, a fault file, goals or an
// exercise. find_data_file() decides whether that is a path or the name of an installed file, finds
// the data folder, and read_file() reads a file, pipe or device within limits of size and time.
// load_model.hpp joins robot and workcell to a Model, with the loaders of protocol/files, which
// accept the JSON and the plain form. Files are written by atomic_write.hpp: a complete draft in
// the folder of the target is renamed, so that a reader never gets half a file. The port file
// (port_file.hpp) is such a file, removed at the end. raster.hpp and png.hpp turn a picture of
// tools/drawing, or an image of the camera, into PNG bytes. descriptor.hpp owns file descriptors;
// sha256.hpp makes digests, of which cell declares one form. All errors of files are a FileError,
// whose message names the file and the reason.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/base/exit_code.hpp"

namespace xr3 {

struct DataFile {
  std::string path;  ///< for messages
  std::string text;
};

/// Maximum size of a data file. Refuses a wrong path, such as a disk image, before reading it.
inline constexpr std::size_t kLargestDataFile = 4UL * 1024 * 1024;

/// Reads a file, pipe or device of at most `max_bytes`, without its byte order mark. Waits at most
/// 10 s for the next bytes of a pipe. Throws FileError.
DataFile read_file(const std::filesystem::path& path, std::size_t max_bytes = kLargestDataFile);

/// Whether find_data_file() treats the text as a path.
bool is_data_path(const std::string& what);

/// `what` is a path if it contains a slash or ends in .json, .txt or .dat; else the name of a file
/// in folder `kind` ("robots" or "workcells") of the data folder; else a file in the current
/// folder. Throws FileError, with the names available.
DataFile find_data_file(const std::string& what, const std::string& kind);

/// Whether the data folder contains this file.
bool has_data_file(const std::string& name, const std::string& kind);

/// The name of no file: the workcell of a robot that has none, an empty table.
inline constexpr const char* kNoWorkcell = "none";

/// The names of the files in folder `kind` of the data folder, and kNoWorkcell among those of
/// workcells, sorted. Throws FileError if there is no data folder.
std::vector<std::string> names_of_data_files(const std::string& kind);

/// The file that makes a folder an exercise.
inline constexpr const char* kExerciseFile = "exercise.json";

/// The folder of the exercises that come with xr3, and of the header robot.h for programs in C.
/// Throws FileError if there is no data folder.
std::filesystem::path exercises_folder();

/// The folder `name` of an installation; without it, the folder `in_checkout` of a checkout, which
/// may not exist. Throws FileError if there is no data folder.
std::filesystem::path installed_folder(const std::string& name, const std::string& in_checkout);

/// The names of these exercises, sorted. Throws FileError if there is no data folder.
std::vector<std::string> names_of_exercises();

/// The data folder: $XR3_DATA if set; else share/xr3 beside the program's bin; else data in the
/// source tree of the build. Throws FileError if it does not exist.
std::filesystem::path data_folder();

}  // namespace xr3
