// Turns the header and the entries of a recording into its lines, each with the check of all bytes
// up to it. Without I/O.
#pragma once

#include <string>

#include "protocol/recording/entry.hpp"
#include "protocol/recording/header.hpp"
#include "protocol/recording/running_check.hpp"

namespace xr3::recording {

/// No line of a recording is longer, with its line feed.
inline constexpr std::size_t kMaxLine = std::size_t{8} << 20U;

class RecordingWriter {
 public:
  /// The first line, with its line feed.
  std::string line(const Header& header);
  /// The next line, with its line feed.
  std::string line(const Entry& entry);

 private:
  std::string checked(std::string json);

  Epoch epoch_ = 0;
  RunningCheck check_;
};

}  // namespace xr3::recording
