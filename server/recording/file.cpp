#include "server/recording/file.hpp"

#include <fcntl.h>
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
// Maximum number of servers that start within one second and record into one folder, or under one
// name.
constexpr int kMaxRunsOfASecond = 100;

Descriptor new_file(const std::string& path) {
  constexpr ::mode_t kOwnerOnly = S_IRUSR | S_IWUSR;
  Descriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly));
  if (file.is_open()) return file;
  if (errno == EEXIST)
    throw FileError(path +
                    ": exists already; a recording replaces no file, so choose another name");
  throw FileError(path + ": the recording cannot be written: " + std::strerror(errno));
}

bool is_folder(const std::string& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
}

/// Makes a folder for this user alone. False if there is something with its name. Throws FileError.
bool make_private_folder(const std::string& path) {
  if (::mkdir(path.c_str(), S_IRWXU) == 0) return true;
  if (errno == EEXIST) return false;
  throw FileError(path + ": the folder of the recordings cannot be made: " + std::strerror(errno));
}

/// A time in UTC; `format` is that of strftime.
std::string utc_text(std::chrono::system_clock::time_point time, const char* format) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm utc{};
  std::array<char, 32> text{};
  ::gmtime_r(&seconds, &utc);
  return {text.data(), std::strftime(text.data(), text.size(), format, &utc)};
}

/// Whether something has this name, such as a symbolic link to nothing.
bool is_taken(const std::string& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0;
}

}  // namespace

std::string make_run_folder(const std::string& folder,
                            std::chrono::system_clock::time_point start) {
  if (!make_private_folder(folder) && !is_folder(folder))
    throw FileError(folder + ": is a file; several cells record into a folder");
  std::string path = folder + "/" + utc_text(start, "%Y-%m-%dT%H-%M-%SZ");
  if (make_private_folder(path)) return path;
  for (int run = 2; run <= kMaxRunsOfASecond; ++run) {
    std::string next = path + "-" + std::to_string(run);
    if (make_private_folder(next)) return next;
  }
  throw FileError(path + ": more than " + std::to_string(kMaxRunsOfASecond) +
                  " servers have started to record here in one second; start again");
}

std::string unused_path(const std::string& path, std::chrono::system_clock::time_point start) {
  if (!is_taken(path)) return path;
  if (is_folder(path)) throw FileError(path + ": is a folder; one cell records into a file");
  const std::string ending = std::filesystem::path(path).extension().string();
  const std::string stem = path.substr(0, path.size() - ending.size());
  const std::string name = stem + utc_text(start, "-%Y%m%dT%H%M%SZ");
  const auto numbered = [&](int run) { return name + "-" + std::to_string(run) + ending; };
  std::string unused = name + ending;
  for (int run = 2; is_taken(unused) && run <= kMaxRunsOfASecond; ++run) unused = numbered(run);
  return unused;
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
