// The file of the log, which is rotated. Independent of the logging library.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/files/descriptor.hpp"

namespace xr3 {

class LogFile {
 public:
  /// Opens the file, or makes it; no symbolic link is followed, now and later. `max_bytes`: of each
  /// file; `max_files`: FILE, FILE.1 and so on, from the newest to the oldest, two or more. Throws
  /// FileError.
  LogFile(std::string path, std::size_t max_bytes, std::size_t max_files);

  /// Appends a message, to a new file if it does not fit into this one. An error is not reported:
  /// there is no other place for it.
  void write(std::string_view message);

 private:
  std::string name(std::size_t number) const;
  void open();
  void rotate();

  std::string path_;
  std::size_t max_bytes_;
  std::size_t max_files_;
  Descriptor file_;
  std::size_t bytes_ = 0;
};

}  // namespace xr3
