#include "cli/exec/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "xr3-run-";

/// The lock of a folder of this user; empty if another process has it, or the folder no longer
/// exists.
Descriptor locked(const fs::path& path) {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  Descriptor folder(::open(path.c_str(), kFlags));
  struct ::stat its {};
  struct ::stat there {};
  const bool is_ours = folder.is_open() && ::flock(folder.get(), LOCK_EX | LOCK_NB) == 0 &&
                       ::fstat(folder.get(), &its) == 0 && its.st_uid == ::geteuid() &&
                       ::lstat(path.c_str(), &there) == 0 && there.st_ino == its.st_ino;
  return is_ours ? std::move(folder) : Descriptor();
}

/// Makes a folder and locks it. Another process may remove a new folder as abandoned before it is
/// locked: then the next one is made.
fs::path make_folder_to_lock() {
  std::string name = fs::temp_directory_path() / (std::string(kPrefix) + "XXXXXX");
  if (::mkdtemp(name.data()) == nullptr)
    throw FileError(name + ": cannot be made: " + std::system_category().message(errno));
  return name;
}

}  // namespace

void remove_abandoned_folders() {
  std::error_code ignored;
  for (const fs::directory_entry& each : fs::directory_iterator(fs::temp_directory_path(), ignored))
    if (each.path().filename().string().starts_with(kPrefix))
      if (const Descriptor lock = locked(each); lock.is_open()) fs::remove_all(each, ignored);
}

RunFolder::RunFolder(const std::optional<ProgramUser>& user) : user_(user) {
  constexpr ::mode_t kPassed = 0710;
  while (!lock_.is_open()) lock_ = locked(path_ = make_folder_to_lock());
  if (user && (::chown(path_.c_str(), ::geteuid(), user->group) != 0 ||
               ::chmod(path_.c_str(), kPassed) != 0))
    throw FileError(path_.string() + ": cannot be given to the group of the program");
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Binding RunFolder::readable(const fs::path& from, const fs::path& to) {
  return readable_by(user_, from, to, path_ / std::to_string(++copies_));
}

}  // namespace xr3
