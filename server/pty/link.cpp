#include "server/pty/link.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string_view>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

/// The target of a symbolic link; empty if there is none.
std::string target_of(const std::string& path) {
  std::array<char, PATH_MAX> target{};
  const ::ssize_t size = ::readlink(path.c_str(), target.data(), target.size());
  return size < 0 ? "" : std::string(target.data(), static_cast<std::size_t>(size));
}

bool exists(const std::string& path) {
  struct ::stat status {};
  return ::lstat(path.c_str(), &status) == 0;
}

/// Whether the open file is still the one at this path: its last owner may have removed it.
bool is_file_at(int file, const std::string& path) {
  struct ::stat mine {};
  struct ::stat there {};
  return ::fstat(file, &mine) == 0 && ::lstat(path.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

std::string content_of(int file) {
  std::array<char, PATH_MAX> text{};
  const ::ssize_t size = ::pread(file, text.data(), text.size(), 0);
  return size < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(size));
}

}  // namespace

PtyLink::PtyLink(std::string path, const std::string& slave)
    : path_(std::move(path)), lock_path_(path_ + ".lock") {
  lock();
  try {
    if (exists(path_) && !is_ours()) fail("is there already and is no link of xr3; it is kept");
    point_to(slave);
  } catch (const FileError&) {
    if (content_of(lock_.get()).empty()) ::unlink(lock_path_.c_str());
    throw;
  }
}

PtyLink::~PtyLink() {
  if (target_of(path_) == slave_) ::unlink(path_.c_str());
  if (is_file_at(lock_.get(), lock_path_)) ::unlink(lock_path_.c_str());
}

void PtyLink::fail(const std::string& why) const {
  throw FileError(path_ + ": the path for a pseudo-terminal " + why);
}

void PtyLink::lock() {
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  for (;;) {
    Descriptor file(::open(lock_path_.c_str(), kFlags, S_IRUSR | S_IWUSR));
    if (!file.is_open()) fail("cannot be locked (" + lock_path_ + "): " + std::strerror(errno));
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
      fail("is in use by another xr3, which has locked " + lock_path_);
    lock_ = std::move(file);
    if (is_file_at(lock_.get(), lock_path_)) return;
  }
}

// The lock file has the targets of the last link and of the one that was about to be made, a line
// each.
bool PtyLink::is_ours() const {
  const std::string target = target_of(path_);
  const std::string recorded = content_of(lock_.get());
  std::string_view rest = recorded;
  while (!target.empty() && !rest.empty()) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    if (rest.substr(0, end) == target) return true;
    rest.remove_prefix(end + 1);
  }
  return false;
}

void PtyLink::record(const std::string& slave) {
  const std::string last = exists(path_) ? target_of(path_) + "\n" : "";
  const std::string text = last + slave + "\n";
  const auto size = static_cast<::ssize_t>(text.size());
  if (::ftruncate(lock_.get(), 0) != 0 ||
      ::pwrite(lock_.get(), text.data(), text.size(), 0) != size)
    fail("cannot be recorded in " + lock_path_ + ": " + std::strerror(errno));
}

void PtyLink::point_to(const std::string& slave) {
  record(slave);
  const std::string draft = path_ + "." + std::to_string(::getpid());
  ::unlink(draft.c_str());
  const bool is_made =
      ::symlink(slave.c_str(), draft.c_str()) == 0 && ::rename(draft.c_str(), path_.c_str()) == 0;
  const int why = errno;
  if (!is_made) ::unlink(draft.c_str());
  if (!is_made) fail(std::string("cannot be made: ") + std::strerror(why));
  slave_ = slave;
}

}  // namespace xr3
