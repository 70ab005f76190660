// The file of a recording: only new files, readable by their owner alone, and never larger than
// allowed. Lines are collected, and written together without waiting for the disk.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/files/descriptor.hpp"

namespace xr3 {

/// Makes `folder` unless it exists, and in it a new folder for the recordings of one run, named
/// after the time of its start in UTC: 2026-11-23T15-29-49Z, or …Z-2 if that exists. Both are for
/// this user alone. Returns the path of the new folder. Throws FileError.
std::string make_run_folder(const std::string& folder, std::chrono::system_clock::time_point start);

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
