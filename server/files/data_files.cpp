#include "server/files/data_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace xr3 {
namespace {

namespace fs = std::filesystem;

// No data file is this large. Refuses a wrong path, such as a disk image, before reading it.
constexpr std::uintmax_t kLargestFile = 64 * 1024 * 1024;

// Editors on Windows may write one.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_path(const std::string& what) {
  if (what.find('/') != std::string::npos) return true;
  return what.ends_with(".json") || what.ends_with(".txt") || what.ends_with(".dat");
}

std::string names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

fs::path path_of(const std::string& name, const std::string& kind) {
  return data_folder() / kind / (name + ".json");
}

}  // namespace

DataFile read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw FileError(path.string() + ": is a folder, not a file");
  if (fs::file_size(path, error) > kLargestFile && !error) {
    throw FileError(path.string() + ": too large; a data file has at most 64 MiB");
  }
  const std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string() + ": cannot be read: " + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  std::string content = std::move(text).str();
  if (content.starts_with(kByteOrderMark)) content.erase(0, kByteOrderMark.size());
  return {path.string(), std::move(content)};
}

DataFile find_data_file(const std::string& what, const std::string& kind) {
  if (is_path(what)) return read_file(what);
  if (!has_data_file(what, kind)) {
    std::error_code error;
    if (fs::is_regular_file(what, error)) return read_file(what);
    throw FileError("there is no " + kind.substr(0, kind.size() - 1) + " named " + what +
                    "; use one of: " + names_in(data_folder() / kind) + "; or the path of a file");
  }
  return read_file(path_of(what, kind));
}

bool has_data_file(const std::string& name, const std::string& kind) {
  std::error_code error;
  return fs::is_regular_file(path_of(name, kind), error);
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
