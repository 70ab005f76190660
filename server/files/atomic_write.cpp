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

fs::path followed(const fs::path& path) {
  std::error_code error;
  return fs::is_symlink(path, error) ? fs::weakly_canonical(path) : path;
}

/// The status of a target that does not exist, or is a regular file.
fs::file_status writable_status(const fs::path& target) {
  std::error_code error;
  fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(target, "it is not a file");
  return status;
}

}  // namespace

// --- A draft.

Draft::Draft(const fs::path& path, ::mode_t rights)
    : target_(followed(path)),
      before_(writable_status(target_)),
      path_(target_.string() + "." + std::to_string(::getpid())) {
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, rights));
  if (!file_.is_open()) fail(target_, std::strerror(errno));
}

Draft::~Draft() {
  std::error_code ignored;
  if (!is_renamed_) fs::remove(path_, ignored);
}

void Draft::append(std::string_view text) {
  if (!write_all(file_.get(), text)) fail(target_, std::strerror(errno));
}

void Draft::sync() {
  if (::fsync(file_.get()) != 0) fail(target_, std::strerror(errno));
}

bool Draft::take_name(Existing existing) {
  std::error_code ignored;
  if (fs::exists(before_)) fs::permissions(path_, before_.permissions(), ignored);
  const unsigned flags = existing == Existing::kKeep ? RENAME_NOREPLACE : 0;
  int failed = ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), flags);
  if (failed != 0 && flags != 0 && errno == EINVAL) {  // the file system has no RENAME_NOREPLACE
    if (fs::exists(target_, ignored)) return false;
    failed = ::rename(path_.c_str(), target_.c_str());
  }
  if (failed != 0 && flags != 0 && errno == EEXIST) return false;
  if (failed != 0) fail(target_, std::strerror(errno));
  is_renamed_ = true;
  return true;
}

// --- Whole files.

bool write_file_atomically(const fs::path& path, const std::string& text, Existing existing,
                           const std::function<void(const DataFile&)>& check) {
  std::error_code error;
  if (existing == Existing::kKeep && fs::is_regular_file(path, error)) return false;
  Draft draft(path);
  draft.append(text);
  draft.sync();
  check(read_file(draft.path()));
  return draft.take_name(existing);
}

void write_file(const fs::path& path, const std::string& text) {
  Draft draft(path);
  draft.append(text);
  draft.sync();
  draft.take_name(Existing::kReplace);
}

}  // namespace xr3
