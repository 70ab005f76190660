// The file of a recording: only new files, readable by their owner alone, and never larger than
// allowed. Lines are collected, and written together without waiting for the disk.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/files/descriptor.hpp"

namespace xr3 {

/// A time in UTC; `format` is that of strftime.
std::string utc_text(std::chrono::system_clock::time_point time, const char* format);

/// `stem` and `ending` together, or with -2, -3 and so on between them, if that exists.
std::string first_unused(const std::string& stem, const std::string& ending);

/// The path if nothing has it yet; else with the time of the start of a run in UTC before its
/// ending: a.xr3rec becomes a-20261123T152949Z.xr3rec, or …Z-2.xr3rec if that exists. Throws
/// FileError if it is a folder.
std::string unused_path(const std::string& path, std::chrono::system_clock::time_point start);

class RecordingFile {
 public:
  /// Makes the file. Throws FileError, also if there is one already.
  explicit RecordingFile(std::string path);
  /// Writes the collected lines, and closes the file.
  ~RecordingFile() { flush(); }

  /// Adds a whole line.
  void add(std::string_view line);
  /// Writes the collected lines. After a failure the file ends with its last whole line, if
  /// possible.
  void flush();

  /// The size of the file when everything is written.
  std::uint64_t size() const { return written_ + unwritten_.size(); }
  const std::string& path() const { return path_; }
  /// The reason why nothing more is written; empty while it is.
  const std::string& failure() const { return failure_; }

 private:
  std::string path_;
  Descriptor file_;
  std::string unwritten_;
  std::uint64_t written_ = 0;
  std::string failure_;
};

}  // namespace xr3
