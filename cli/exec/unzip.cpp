#include "cli/exec/unzip.hpp"

#include <unzip.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "protocol/text/printable.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

/// Whether a name stays below the folder in which it is unpacked.
bool is_inside(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && name.find('\\') == std::string::npos &&
         std::ranges::none_of(path, [](const fs::path& part) { return part == ".."; });
}

class Archive {
 public:
  Archive(const fs::path& path, fs::path folder)
      : path_(path), folder_(std::move(folder)), file_(::unzOpen64(path.c_str())) {
    if (file_ == nullptr) fail("is no zip archive, or cannot be read");
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive() { ::unzClose(file_); }

  void unpack() {
    fs::create_directories(folder_);
    std::size_t count = 0;
    int state = ::unzGoToFirstFile(file_);
    for (; state == UNZ_OK; state = ::unzGoToNextFile(file_)) {
      if (++count > kMaxZipFiles) fail("has more than " + std::to_string(kMaxZipFiles) + " files");
      unpack_entry();
    }
    if (state != UNZ_END_OF_LIST_OF_FILE) fail("is damaged");
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw FileError(path_.string() + ": " + why);
  }

  std::string name_of_entry() const {
    constexpr std::size_t kMaxName = 1024;
    std::array<char, kMaxName> name{};
    ::unz_file_info64 info{};
    if (::unzGetCurrentFileInfo64(file_, &info, name.data(), name.size(), nullptr, 0, nullptr, 0) !=
        UNZ_OK)
      fail("is damaged");
    if (info.size_filename >= kMaxName) fail("has a name that is too long");
    return {name.data(), info.size_filename};
  }

  void unpack_entry() {
    const std::string name = name_of_entry();
    if (!is_inside(name) || name.find('\0') != std::string::npos)
      fail("the name " + printable_line(name) + " leads out of the folder");
    const fs::path path = folder_ / name;
    std::error_code error;
    fs::create_directories(name.ends_with('/') ? path : path.parent_path(), error);
    if (error) fail(printable_line(name) + " cannot be made: " + error.message());
    if (!name.ends_with('/')) write(name, path);
  }

  void write(const std::string& name, const fs::path& path) {
    std::ofstream out(path, std::ios::binary);
    if (!out) fail(printable_line(name) + " cannot be written");
    if (::unzOpenCurrentFile(file_) != UNZ_OK)
      fail(printable_line(name) + " cannot be unpacked; it may be encrypted");
    std::array<char, 65536> piece;
    int count = 0;
    while ((count = ::unzReadCurrentFile(file_, piece.data(), piece.size())) > 0) {
      bytes_ += static_cast<std::uint64_t>(count);
      if (bytes_ > kMaxZipBytes)
        fail("has more than " + std::to_string(kMaxZipBytes >> 20U) + " MiB");
      out.write(piece.data(), count);
    }
    const bool is_whole = ::unzCloseCurrentFile(file_) == UNZ_OK;
    if (count < 0 || !is_whole || !out.flush()) fail(printable_line(name) + " is damaged");
  }

  fs::path path_;
  fs::path folder_;
  ::unzFile file_;
  std::uint64_t bytes_ = 0;  ///< number unpacked so far
};

}  // namespace

void unzip(const fs::path& archive, const fs::path& folder) { Archive(archive, folder).unpack(); }

}  // namespace xr3
