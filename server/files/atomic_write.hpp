// Writes files atomically: a complete draft in the same folder is renamed to the file's name.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "server/files/data_files.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// The treatment of an existing file.
enum class Existing : std::uint8_t { kKeep, kReplace };

/// A file that is written as it grows. Until take_name() it has a name of its own in the folder of
/// the target, and the destructor removes it. Each function throws FileError.
class Draft {
 public:
  /// Begins a draft. Follows symbolic links. The target must not exist, or be a regular file.
  /// `rights`: those of a new file, before the umask.
  explicit Draft(const std::filesystem::path& target, ::mode_t rights = 0666);
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft();

  const std::filesystem::path& path() const { return path_; }
  void append(std::string_view text);
  /// Waits until the text is on the disk.
  void sync();
  /// Renames the draft, with the permissions of the file that it replaces. False if the target
  /// exists and is to be kept.
  bool take_name(Existing existing);

 private:
  std::filesystem::path target_;
  std::filesystem::file_status before_;
  std::filesystem::path path_;
  Descriptor file_;
  bool is_renamed_ = false;
};

/// Writes the text to a file. Before the rename it reads the draft back and passes it to `check`,
/// which may throw. Returns false if the file exists and `existing` is kKeep. Throws FileError.
/// After false or an exception nothing is changed. Follows symbolic links; keeps the permissions of
/// the file.
bool write_file_atomically(const std::filesystem::path& path, const std::string& text,
                           Existing existing, const std::function<void(const DataFile&)>& check);

/// Writes the text to a file like write_file_atomically(), over an existing file and without a
/// check.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace xr3
