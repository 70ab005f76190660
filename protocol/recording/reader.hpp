// Reads a recording strictly, line by line, from bytes that the caller has read. A recording may
// come from anywhere: lines and memory are bounded, and errors contain the line, the JSON pointer
// and what is allowed. Without I/O.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/recording/entry.hpp"
#include "protocol/recording/header.hpp"
#include "protocol/recording/running_check.hpp"
#include "protocol/recording/writer.hpp"

namespace xr3::recording {

class RecordingReader {
 public:
  /// `file` is its name for messages.
  explicit RecordingReader(std::string file) : file_(std::move(file)) {}

  /// Adds bytes of the file. Call it when header() or next() have returned nullopt.
  void add(std::string_view bytes);
  /// The file has no more bytes. Throws DataError if its last line is no beginning of a line.
  void end();

  /// The first line; nullopt if more bytes are needed, or after end() if there is none. Throws
  /// DataError.
  std::optional<Header> header();
  /// The next line after the header, likewise. Throws DataError.
  std::optional<Entry> next();

  /// The number of the line read last, from 1.
  std::int64_t line() const { return line_; }
  /// Bytes after the last whole line, which count for nothing; after end().
  std::size_t cut_off() const { return has_ended_ ? text_.size() - begin_ : 0; }
  /// Whether the recording ends with its own last entry.
  bool is_whole() const { return is_whole_; }

 private:
  std::optional<std::string_view> next_line();
  void check_line(std::string_view line);
  [[noreturn]] void fail(std::int64_t line, const std::string& found,
                         const std::string& allowed) const;
  [[noreturn]] void fail(data::Reading& reading) const;
  void require_json(const JsonDocument& document) const;

  std::string file_;
  std::string text_;          ///< added and not read yet, from begin_ on
  std::size_t begin_ = 0;     ///< offset of the next line
  std::size_t searched_ = 0;  ///< up to here, the next line has no end
  std::int64_t line_ = 0;
  Epoch epoch_ = 0;
  RunningCheck check_;
  bool has_ended_ = false;
  bool is_whole_ = false;
};

}  // namespace xr3::recording
