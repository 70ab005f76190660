// Transcripts: what a client sends and what it gets, as plain text that reads as documentation and
// is played as a test. The format is described in tests/transcripts/README.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"

namespace xr3::test {

enum class StepKind : std::uint8_t {
  kSend,    ///< `>`
  kExpect,  ///< `<`: all that the line has received since the last of these
  kPass,    ///< `~`
  kClosed,  ///< `! closed`
  kHangUp,  ///< `! hang up`
};

struct TranscriptStep {
  int line_number = 0;  ///< in the file, from 1
  StepKind kind = StepKind::kSend;
  int wire = 1;  ///< the serial line concerned
  std::string bytes;
  Tick ticks = 0;
};

struct Transcript {
  std::string file;
  std::string robot = "rhino-xr3";
  std::string workcell = "rhino-xr3";
  Profile profile = Profile::kPaper;
  std::vector<TranscriptStep> steps;
};

/// Reads a transcript. Throws std::runtime_error with file and line where it breaks the format.
Transcript parse_transcript(std::string_view text, const std::string& file);

/// Plays it against a cell of its own. One entry for each expectation that failed, as
/// "file:line: expected ..., got ...".
std::vector<std::string> play(const Transcript& transcript);

}  // namespace xr3::test
