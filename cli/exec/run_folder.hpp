// The private folder of a run: its pseudo-terminal, and copies of files for another user.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/exec/program_user.hpp"
#include "cli/exec/readable.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// Removes the folders of runs whose judge was killed.
void remove_abandoned_folders();

class RunFolder {
 public:
  /// Makes the folder. `user`: the user of the program, who may traverse the folder. Throws
  /// FileError.
  explicit RunFolder(const std::optional<ProgramUser>& user);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  std::string file(const char* name) const { return path_ / name; }
  /// The binding of readable_by(), with the copy in this folder.
  Binding readable(const std::filesystem::path& from, const std::filesystem::path& to);

 private:
  std::optional<ProgramUser> user_;
  std::filesystem::path path_;
  Descriptor lock_;  ///< lock of the folder, held for the lifetime of this
  int copies_ = 0;
};

}  // namespace xr3
