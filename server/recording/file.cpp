#include "server/recording/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

// With so much collected, it is written at once.
constexpr std::size_t kMaxUnwritten = std::size_t{256} * 1024;

int new_file(const std::string& path) {
  constexpr ::mode_t kOwnerOnly = S_IRUSR | S_IWUSR;
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly);
  if (file >= 0) return file;
  if (errno == EEXIST)
    throw FileError(path +
                    ": exists already; a recording replaces no file, so choose another name");
  throw FileError(path + ": the recording cannot be written: " + std::strerror(errno));
}

}  // namespace

void make_private_folder(const std::string& path) {
  if (::mkdir(path.c_str(), S_IRWXU) == 0) return;
  struct stat found {};
  const bool is_folder = ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
  if (errno == EEXIST && is_folder) return;
  throw FileError(path + ": the folder of the recordings cannot be made: " + std::strerror(errno));
}

RecordingFile::RecordingFile(std::string path) : path_(std::move(path)), file_(new_file(path_)) {}

RecordingFile::~RecordingFile() {
  flush();
  ::close(file_);
}

void RecordingFile::add(std::string_view line) {
  if (!failure_.empty()) return;
  unwritten_ += line;
  if (unwritten_.size() >= kMaxUnwritten) flush();
}

void RecordingFile::flush() {
  std::size_t done = 0;
  while (done < unwritten_.size() && failure_.empty()) {
    const ::ssize_t wrote = ::write(file_, unwritten_.data() + done, unwritten_.size() - done);
    if (wrote > 0) done += static_cast<std::size_t>(wrote);
    if (wrote < 0 && errno != EINTR) failure_ = std::strerror(errno);
  }
  if (!failure_.empty()) {
    const std::size_t feed = unwritten_.rfind('\n', done == 0 ? 0 : done - 1);
    done = done == 0 || feed == std::string::npos ? 0 : feed + 1;
    const int failed = ::ftruncate(file_, static_cast<::off_t>(written_ + done));
    (void)failed;  // then the last line is incomplete, which readers accept
    unwritten_.resize(done);
  }
  written_ += done;
  unwritten_.clear();
}

}  // namespace xr3
