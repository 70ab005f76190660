// The file of a recording, read piece by piece.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "protocol/recording/reader.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

class RecordingSource {
 public:
  /// Each function throws FileError if the file cannot be read, and DataError if it is damaged.
  explicit RecordingSource(const std::string& path);

  /// The first line.
  recording::Header header();
  /// The next line after it; nullopt at the end.
  std::optional<recording::Entry> next();
  const recording::RecordingReader& reader() const { return reader_; }

 private:
  template <class Item, class Take>
  std::optional<Item> next_of(const Take& take);
  bool has_more();
  [[noreturn]] void fail() const;

  std::string path_;
  Descriptor file_;
  recording::RecordingReader reader_;
  bool is_at_end_ = false;
  std::array<char, 65536> piece_{};
};

}  // namespace xr3
