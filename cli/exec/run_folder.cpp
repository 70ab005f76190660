#include "cli/exec/run_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "server/files/data_files.hpp"

namespace xr3 {

RunFolder::RunFolder(const std::optional<ProgramUser>& user) : user_(user) {
  constexpr ::mode_t kPassed = 0710;
  std::string name = std::filesystem::temp_directory_path() / "xr3-XXXXXX";
  const bool is_made = ::mkdtemp(name.data()) != nullptr &&
                       (!user || (::chown(name.c_str(), ::geteuid(), user->group) == 0 &&
                                  ::chmod(name.c_str(), kPassed) == 0));
  if (!is_made)
    throw FileError(name + ": cannot be made: " + std::system_category().message(errno));
  path_ = name;
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Binding RunFolder::readable(const std::filesystem::path& from, const std::filesystem::path& to) {
  return readable_by(user_, from, to, path_ / std::to_string(++copies_));
}

}  // namespace xr3
