#include "server/files/data_files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "server/files/descriptor.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

// Maximum time for the next bytes of a pipe, such as the shell makes for <(command).
constexpr int kMaxWaitMs = 10'000;

// Editors on Windows may write a byte order mark.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string list_of_names(const std::string& kind) {
  std::string list;
  for (const std::string& name : names_of_data_files(kind))
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

fs::path path_of(const std::string& name, const std::string& kind) {
  return data_folder() / kind / (name + ".json");
}

/// An open file, pipe or device. Reading never waits long, and never for a pipe without a writer.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : name_(path.string()), file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (!file_.is_open()) fail(std::string("cannot be read: ") + std::strerror(errno));
  }

  std::string read_all(std::size_t max_bytes) {
    std::string content;
    std::array<char, 65536> piece;
    for (;;) {
      const ::ssize_t count = ::read(file_.get(), piece.data(), piece.size());
      if (count == 0) return content;
      if (count > 0) content.append(piece.data(), static_cast<std::size_t>(count));
      if (content.size() > max_bytes)
        fail("too large; a data file has at most " + std::to_string(max_bytes >> 20U) + " MiB");
      if (count < 0) wait(errno);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw FileError(name_ + ": " + why); }

  void wait(int why) const {
    if (why == EINTR) return;
    if (why != EAGAIN) fail(std::string("cannot be read: ") + std::strerror(why));
    pollfd readable{file_.get(), POLLIN, 0};
    if (::poll(&readable, 1, kMaxWaitMs) == 0) fail("cannot be read: no data for 10 s");
  }

  std::string name_;
  Descriptor file_;
};

}  // namespace

DataFile read_file(const fs::path& path, std::size_t max_bytes) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw FileError(path.string() + ": is a folder, not a file");
  std::string content = OpenFile(path).read_all(max_bytes);
  if (content.starts_with(kByteOrderMark)) content.erase(0, kByteOrderMark.size());
  return {path.string(), std::move(content)};
}

bool is_data_path(const std::string& what) {
  if (what.find('/') != std::string::npos) return true;
  return what.ends_with(".json") || what.ends_with(".txt") || what.ends_with(".dat");
}

DataFile find_data_file(const std::string& what, const std::string& kind) {
  if (is_data_path(what)) return read_file(what);
  if (!has_data_file(what, kind)) {
    std::error_code error;
    if (fs::is_regular_file(what, error)) return read_file(what);
    throw FileError("there is no " + kind.substr(0, kind.size() - 1) + " named " + what +
                    "; use one of: " + list_of_names(kind) + "; or the path of a file");
  }
  return read_file(path_of(what, kind));
}

bool has_data_file(const std::string& name, const std::string& kind) {
  std::error_code error;
  return fs::is_regular_file(path_of(name, kind), error);
}

std::vector<std::string> names_of_data_files(const std::string& kind) {
  std::vector<std::string> names;
  if (kind == "workcells") names.emplace_back(kNoWorkcell);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder() / kind, error))
    names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path installed_folder(const std::string& name, const std::string& in_checkout) {
  const fs::path data = data_folder();
  std::error_code error;
  const fs::path installed = data / name;
  return fs::is_directory(installed, error) ? installed : data / ".." / in_checkout;
}

fs::path exercises_folder() { return installed_folder("exercises", "docs/course"); }

std::vector<std::string> names_of_exercises() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(exercises_folder(), error))
    if (fs::is_regular_file(entry.path() / kExerciseFile, error))
      names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path data_folder() {
  std::error_code error;
  if (const char* named = std::getenv("XR3_DATA")) {
    if (fs::is_directory(fs::path(named) / "robots", error)) return named;
    throw FileError(std::string("XR3_DATA=") + named + ": has no folder robots");
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder :
       {program.parent_path() / "../share/xr3", program.parent_path() / "../../data"}) {
    if (fs::is_directory(folder / "robots", error)) return fs::weakly_canonical(folder, error);
  }
  throw FileError("no data folder found beside " + program.string() + "; set XR3_DATA to its path");
}

}  // namespace xr3
