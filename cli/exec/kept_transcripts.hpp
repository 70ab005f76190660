// The transcripts of two runs of a program that differ, kept until all runs have ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/exec/run_folder.hpp"
#include "core/model.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {

class KeptTranscripts {
 public:
  /// Makes a folder for them. Throws FileError.
  KeptTranscripts() : folder_(std::nullopt) {}

  /// Keeps the transcript with this digest, unless it or two others are kept already. Does nothing
  /// without a digest. May be called by several processes at a time. Throws FileError.
  void keep(const std::string& digest, const std::string& text) const;

  /// Sets the difference of the first report whose kept transcript differs from that of an earlier
  /// one. Throws FileError.
  void compare(std::vector<RunReport>& reports, Profile profile) const;

 private:
  std::filesystem::path path_of(const std::string& digest) const;
  bool has(const std::string& digest) const;
  std::ptrdiff_t count() const;
  std::string text_of(const std::string& digest) const;

  RunFolder folder_;
};

}  // namespace xr3
