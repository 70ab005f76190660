// Finds and reads robot and workcell files: by the name of one that comes with xr3, or by path.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace xr3 {

/// A file that cannot be found or read; the message says which and what to do.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DataFile {
  std::string path;  ///< for messages
  std::string text;
};

/// The whole file, but for a byte order mark. Throws FileError.
DataFile read_file(const std::filesystem::path& path);

/// `what` is a path if it has a slash or ends in .json, .txt or .dat; else the name of a file in the
/// data folder's `kind` ("robots", "workcells"); else a file of the current folder. Throws FileError,
/// naming those that there are.
DataFile find_data_file(const std::string& what, const std::string& kind);

/// Whether the data folder has such a file.
bool has_data_file(const std::string& name, const std::string& kind);

/// The folder of data files: $XR3_DATA, or share/xr3 beside the program's bin, or data in the source
/// tree that the program was built in. Throws FileError if there is none.
std::filesystem::path data_folder();

}  // namespace xr3
