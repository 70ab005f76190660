#include "server/recording/folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "server/files/data_files.hpp"
#include "server/files/descriptor.hpp"
#include "server/recording/file.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRecordingEnding = ".xr3rec";
// The form of a time in a name; 0 stands for any digit.
constexpr std::string_view kTimeForm = "0000-00-00T00-00-00Z";
constexpr const char* kTimeFormat = "%Y-%m-%dT%H-%M-%SZ";

bool is_folder(const std::string& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
}

void make_private_folder(const std::string& path, const char* why_no_file) {
  if (::mkdir(path.c_str(), S_IRWXU) == 0) return;
  if (errno != EEXIST)
    throw FileError(path +
                    ": the folder of the recordings cannot be made: " + std::strerror(errno));
  if (!is_folder(path)) throw FileError(path + ": is a file; " + why_no_file);
}

bool is_digit(char c) { return '0' <= c && c <= '9'; }

bool is_time(std::string_view text) {
  return std::ranges::equal(
      text, kTimeForm, [](char c, char form) { return form == '0' ? is_digit(c) : c == form; });
}

/// Whether the text is the end of a name after the time: empty, or `-2`, `-3`...
bool is_run(std::string_view text) {
  constexpr std::size_t kMaxDigits = 3;
  if (text.empty()) return true;
  const std::string_view digits = text.substr(1);
  return text.front() == '-' && !digits.empty() && digits.size() <= kMaxDigits &&
         digits.front() != '0' && digits != "1" && std::ranges::all_of(digits, is_digit);
}

/// The order of the names in time: `…Z-10` begins after `…Z-9`.
std::pair<std::string_view, std::string_view> time_and_run(std::string_view name) {
  name.remove_suffix(kRecordingEnding.size());
  return {name.substr(0, kTimeForm.size()), name.substr(kTimeForm.size())};
}

bool is_earlier(const std::string& one, const std::string& other) {
  const auto [time, run] = time_and_run(one);
  const auto [other_time, other_run] = time_and_run(other);
  if (time != other_time) return time < other_time;
  return run.size() != other_run.size() ? run.size() < other_run.size() : run < other_run;
}

/// The recordings in the folder of a cell, without the folder.
std::vector<std::string> recordings_in(const std::string& of_cell) {
  std::vector<std::string> names;
  std::error_code error;
  for (auto each = fs::directory_iterator(of_cell, error); !error && each != fs::end(each);
       each.increment(error)) {
    std::string name = each->path().filename().string();
    std::error_code ignored;
    if (is_recording_name(name) && fs::is_regular_file(each->symlink_status(ignored)))
      names.push_back(std::move(name));
  }
  return names;
}

/// Whether a server writes the file: see RecordingFile.
bool is_being_written(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  return !file.is_open() || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0;
}

bool is_older(const std::string& path, std::chrono::system_clock::time_point oldest) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 &&
         found.st_mtim.tv_sec < std::chrono::system_clock::to_time_t(oldest);
}

}  // namespace

void make_recording_folder(const std::string& folder) {
  make_private_folder(folder, "several cells record into a folder");
}

std::string new_recording_path(const std::string& folder, const std::string& cell,
                               std::chrono::system_clock::time_point begin) {
  const std::string of_cell = folder + "/" + cell;
  make_private_folder(of_cell, "the recordings of a cell need a folder with its name");
  return first_unused(of_cell + "/" + utc_text(begin, kTimeFormat), std::string(kRecordingEnding));
}

bool is_recording_name(std::string_view name) {
  const std::size_t least = kTimeForm.size() + kRecordingEnding.size();
  if (name.size() < least || !name.ends_with(kRecordingEnding)) return false;
  const auto [time, run] = time_and_run(name);
  return is_time(time) && is_run(run);
}

std::optional<std::string> newest_recording(const std::string& folder, const std::string& cell) {
  const std::string of_cell = folder + "/" + cell;
  const std::vector<std::string> names = recordings_in(of_cell);
  const auto newest = std::ranges::max_element(names, is_earlier);
  if (newest == names.end()) return std::nullopt;
  return of_cell + "/" + *newest;
}

std::vector<std::string> folders_of_cells(const std::string& folder) {
  std::vector<std::string> folders;
  std::error_code error;
  for (auto each = fs::directory_iterator(folder, error); !error && each != fs::end(each);
       each.increment(error)) {
    std::error_code ignored;
    if (fs::is_directory(each->symlink_status(ignored))) folders.push_back(each->path().string());
  }
  return folders;
}

std::size_t delete_old_recordings(const std::string& of_cell,
                                  std::chrono::system_clock::time_point oldest,
                                  const std::function<bool(const std::string& path)>& is_kept) {
  std::size_t deleted = 0;
  for (const std::string& name : recordings_in(of_cell)) {
    const std::string path = of_cell + "/" + name;
    if (!is_older(path, oldest) || is_kept(path) || is_being_written(path)) continue;
    if (::unlink(path.c_str()) == 0) ++deleted;
  }
  if (deleted > 0) ::rmdir(of_cell.c_str());  // not if it has other files
  return deleted;
}

}  // namespace xr3
