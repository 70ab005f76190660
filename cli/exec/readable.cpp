#include "cli/exec/readable.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;
using fs::perms;

bool allows(const fs::path& path, perms wanted) {
  std::error_code error;
  return (fs::status(path, error).permissions() & wanted) == wanted;
}

bool is_readable_itself(const fs::directory_entry& entry) {
  if (entry.is_symlink()) return true;  // followed in the sandbox, if at all
  return allows(
      entry, entry.is_directory() ? perms::others_read | perms::others_exec : perms::others_read);
}

/// Whether every user may read the file or all of the folder.
bool is_readable_by_all(const fs::path& path) {
  for (fs::path above = path.parent_path(); above != above.root_path(); above = above.parent_path())
    if (!allows(above, perms::others_exec)) return false;
  const fs::directory_entry top(path);
  if (!is_readable_itself(top)) return false;
  if (!top.is_directory()) return true;
  for (const fs::directory_entry& each : fs::recursive_directory_iterator(path))
    if (!is_readable_itself(each)) return false;
  return true;
}

/// Copies the files that the user needs, and lets the user's group read them.
class Copy {
 public:
  Copy(const fs::path& from, ::gid_t group) : from_(from), group_(group) {}

  void add(const fs::directory_entry& entry, const fs::path& to) {
    count(entry);
    if (entry.is_symlink()) return fs::copy_symlink(entry, to);
    if (!entry.is_directory() && !entry.is_regular_file()) return;
    const bool is_run = allows(entry, perms::owner_exec);
    if (entry.is_directory())
      fs::create_directory(to);
    else
      fs::copy_file(entry, to);
    if (::chown(to.c_str(), static_cast<::uid_t>(-1), group_) != 0)
      throw FileError(to.string() + ": cannot be given to another group");
    fs::permissions(
        to, perms::owner_all | perms::group_read | (is_run ? perms::group_exec : perms::none));
    if (!entry.is_directory()) return;
    for (const fs::directory_entry& each : fs::directory_iterator(entry))
      add(each, to / each.path().filename());
  }

 private:
  void count(const fs::directory_entry& entry) {
    if (!entry.is_symlink() && entry.is_regular_file()) bytes_ += entry.file_size();
    if (++files_ > kMaxCopiedFiles || bytes_ > kMaxCopiedBytes)
      throw FileError(from_.string() + ": more than " + std::to_string(kMaxCopiedFiles) +
                      " files or 256 MiB to copy for the user of the program; let every user read "
                      "it, and it is not copied");
  }

  const fs::path& from_;
  ::gid_t group_;
  std::size_t files_ = 0;
  std::uintmax_t bytes_ = 0;
};

}  // namespace

Binding readable_by(const std::optional<ProgramUser>& user, const fs::path& from,
                    const fs::path& to, const fs::path& copy) try {
  if (!user || is_readable_by_all(from)) return {from, to};
  Copy(from, user->group).add(fs::directory_entry(from), copy);
  return {copy, to};
} catch (const fs::filesystem_error& error) {
  throw FileError(from.string() + ": cannot be read: " + error.code().message());
}

}  // namespace xr3
