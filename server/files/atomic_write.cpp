#include "server/files/atomic_write.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "server/files/descriptor.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw FileError(path.string() + ": cannot be written: " + why);
}

/// A draft file; the destructor removes it unless take_name() has renamed it.
class Draft {
 public:
  explicit Draft(const fs::path& target)
      : target_(target), path_(target.string() + "." + std::to_string(::getpid())) {}
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    std::error_code ignored;
    if (is_made_) fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }

  void write(const std::string& text) {
    constexpr int kRights = 0666;
    const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kRights);
    if (file < 0) fail(target_, std::strerror(errno));
    is_made_ = true;
    const bool is_written = write_all(file, text) && ::fsync(file) == 0;
    const int why = errno;
    if (::close(file) != 0 || !is_written) fail(target_, std::strerror(why));
  }

  /// Renames the draft. False if the target exists and is to be kept.
  bool take_name(Existing existing) {
    const unsigned flags = existing == Existing::kKeep ? RENAME_NOREPLACE : 0;
    int failed = ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), flags);
    if (failed != 0 && flags != 0 && errno == EINVAL) {  // the file system has no RENAME_NOREPLACE
      std::error_code ignored;
      if (fs::exists(target_, ignored)) return false;
      failed = ::rename(path_.c_str(), target_.c_str());
    }
    if (failed != 0 && flags != 0 && errno == EEXIST) return false;
    if (failed != 0) fail(target_, std::strerror(errno));
    is_made_ = false;
    return true;
  }

 private:
  fs::path target_;
  fs::path path_;
  bool is_made_ = false;
};

}  // namespace

bool write_file_atomically(const fs::path& path, const std::string& text, Existing existing,
                           const std::function<void(const DataFile&)>& check) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path) : path;
  const fs::file_status before = fs::status(target, error);
  const bool is_there = fs::exists(before);
  if (is_there && !fs::is_regular_file(before)) fail(path, "it is not a file");
  if (is_there && existing == Existing::kKeep) return false;
  Draft draft(target);
  draft.write(text);
  check(read_file(draft.path()));
  if (is_there) fs::permissions(draft.path(), before.permissions(), error);
  return draft.take_name(existing);
}

void write_file(const fs::path& path, const std::string& text) {
  write_file_atomically(path, text, Existing::kReplace, [](const DataFile&) {});
}

}  // namespace xr3
