// Files that only their owner may read.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <string>
#include <string_view>

#include "server/files/data_files.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// A new file for writing; an old one of this name is replaced. Throws FileError.
inline Descriptor open_private(const std::string& path) {
  ::unlink(path.c_str());
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (!file.is_open()) throw FileError(path + ": cannot be written");
  return file;
}

/// Writes a new file with this text. Throws FileError.
inline void write_private(const std::string& path, std::string_view text) {
  if (!write_all(open_private(path).get(), text)) throw FileError(path + ": cannot be written");
}

}  // namespace xr3
