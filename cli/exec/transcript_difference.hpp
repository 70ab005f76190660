// The first difference of two runs of a program, from their transcripts as text.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"

namespace xr3 {

/// The transcript of a run in the form of TranscriptText.
struct NamedTranscript {
  std::string name;  ///< name of the run in the sentence, such as `run 2`
  std::string_view text;
};

/// A sentence about the first difference: the serial line, the byte, and for each run its bytes,
/// their meaning and their tick. It does not depend on how the bytes were cut into packets. Without
/// a difference in the bytes it says so: the runs differ later than the text, or at their end.
/// Precondition: TranscriptText wrote both.
std::string first_difference(const NamedTranscript& one, const NamedTranscript& other,
                             Profile profile);

}  // namespace xr3
