#include "server/recording/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

// Size of collected lines at which they are written at once.
constexpr std::size_t kMaxUnwritten = std::size_t{256} * 1024;
// Maximum number of recordings that begin within one second under one name.
constexpr int kMaxRunsOfASecond = 100;

Descriptor new_file(const std::string& path) {
  constexpr ::mode_t kOwnerOnly = S_IRUSR | S_IWUSR;
  Descriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly));
  if (file.is_open()) {
    ::flock(file.get(), LOCK_SH | LOCK_NB);  // so that delete_old_recordings() keeps it
    return file;
  }
  if (errno == EEXIST)
    throw FileError(path +
                    ": exists already; a recording replaces no file, so choose another name");
  throw FileError(path + ": the recording cannot be written: " + std::strerror(errno));
}

/// Whether something has this name, such as a symbolic link to nothing.
bool is_taken(const std::string& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0;
}

}  // namespace

std::string utc_text(std::chrono::system_clock::time_point time, const char* format) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm utc{};
  std::array<char, 32> text{};
  ::gmtime_r(&seconds, &utc);
  return {text.data(), std::strftime(text.data(), text.size(), format, &utc)};
}

std::string first_unused(const std::string& stem, const std::string& ending) {
  std::string unused = stem + ending;
  for (int run = 2; is_taken(unused) && run <= kMaxRunsOfASecond; ++run)
    unused = stem + "-" + std::to_string(run) + ending;
  return unused;
}

std::string unused_path(const std::string& path, std::chrono::system_clock::time_point start) {
  if (!is_taken(path)) return path;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw FileError(path + ": is a folder; one cell records into a file");
  const std::string ending = std::filesystem::path(path).extension().string();
  const std::string stem = path.substr(0, path.size() - ending.size());
  return first_unused(stem + utc_text(start, "-%Y%m%dT%H%M%SZ"), ending);
}

RecordingFile::RecordingFile(std::string path) : path_(std::move(path)), file_(new_file(path_)) {}

void RecordingFile::add(std::string_view line) {
  if (!failure_.empty()) return;
  unwritten_ += line;
  if (unwritten_.size() >= kMaxUnwritten) flush();
}

void RecordingFile::flush() {
  std::size_t done = 0;
  while (done < unwritten_.size() && failure_.empty()) {
    const ::ssize_t wrote =
        ::write(file_.get(), unwritten_.data() + done, unwritten_.size() - done);
    if (wrote > 0) done += static_cast<std::size_t>(wrote);
    if (wrote < 0 && errno != EINTR) failure_ = std::strerror(errno);
  }
  if (!failure_.empty()) {
    const std::size_t feed = unwritten_.rfind('\n', done == 0 ? 0 : done - 1);
    done = done == 0 || feed == std::string::npos ? 0 : feed + 1;
    const int failed = ::ftruncate(file_.get(), static_cast<::off_t>(written_ + done));
    (void)failed;  // ignored: the last line is then incomplete, which readers accept
    unwritten_.resize(done);
  }
  written_ += done;
  unwritten_.clear();
}

}  // namespace xr3
