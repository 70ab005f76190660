// Transcripts: what a client sends and receives, as plain text that is both documentation and a
// test. tests/transcripts/README.md describes the format.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"

namespace xr3::test {

enum class StepKind : std::uint8_t {
  kSend,    ///< `>`
  kExpect,  ///< `<`: all bytes that the line has received since the previous one
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

/// Reads a transcript. Throws std::runtime_error with file and line for invalid text.
Transcript parse_transcript(std::string_view text, const std::string& file);

/// Plays it against a new cell. Returns an entry "file:line: expected ..., got ..." for each failed
/// expectation.
std::vector<std::string> play(const Transcript& transcript);

}  // namespace xr3::test
