#include "server/log_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

std::string open_failure(int error) {
  if (error == ELOOP) return "it is a symbolic link, which is not followed; name the file itself";
  return std::strerror(error);
}

}  // namespace

LogFile::LogFile(std::string path, std::size_t max_bytes, std::size_t max_files)
    : path_(std::move(path)), max_bytes_(max_bytes), max_files_(max_files) {
  open();
  if (!file_.is_open())
    throw FileError(path_ + ": the log cannot be written: " + open_failure(errno));
}

void LogFile::write(std::string_view message) {
  if (bytes_ > 0 && bytes_ + message.size() > max_bytes_) rotate();
  if (!file_.is_open()) open();
  write_all(file_.get(), message);
  bytes_ += message.size();
}

std::string LogFile::name(std::size_t number) const {
  return number == 0 ? path_ : path_ + "." + std::to_string(number);
}

void LogFile::open() {
  constexpr ::mode_t kRights = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;
  constexpr int kHow = O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
  file_ = Descriptor(::open(path_.c_str(), kHow, kRights));
  struct ::stat status {};
  const bool is_known = file_.is_open() && ::fstat(file_.get(), &status) == 0;
  bytes_ = is_known ? static_cast<std::size_t>(status.st_size) : 0;
}

// A file that cannot be renamed begins anew, so that the log stays within its size.
void LogFile::rotate() {
  for (std::size_t i = max_files_ - 1; i > 0; --i)
    std::rename(name(i - 1).c_str(), name(i).c_str());
  open();
  if (bytes_ > 0 && ::ftruncate(file_.get(), 0) == 0) bytes_ = 0;
}

}  // namespace xr3
