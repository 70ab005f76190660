#include "cli/exec/kept_transcripts.hpp"

#include <algorithm>

#include "cli/exec/transcript_difference.hpp"
#include "cli/exec/transcript_text.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

std::string name_of_run(const RunReport& report) { return "run " + std::to_string(report.run); }

}  // namespace

fs::path KeptTranscripts::path_of(const std::string& digest) const {
  return folder_.file(digest.c_str());
}

bool KeptTranscripts::has(const std::string& digest) const {
  return !digest.empty() && fs::exists(path_of(digest));
}

std::string KeptTranscripts::text_of(const std::string& digest) const {
  constexpr std::size_t kMaxRowBytes = 1U << 20U;
  return read_file(path_of(digest), TranscriptText::kMaxBytes + kMaxRowBytes).text;
}

// Counts complete files: a draft has an extension.
std::ptrdiff_t KeptTranscripts::count() const {
  const auto is_complete = [](const fs::directory_entry& each) {
    return !each.path().has_extension();
  };
  return std::ranges::count_if(fs::directory_iterator(folder_.file("")), is_complete);
}

void KeptTranscripts::keep(const std::string& digest, const std::string& text) const {
  constexpr std::ptrdiff_t kEnough = 2;
  if (!digest.empty() && count() < kEnough && !has(digest)) write_file(path_of(digest), text);
}

void KeptTranscripts::compare(std::vector<RunReport>& reports, Profile profile) const {
  const RunReport* first = nullptr;
  for (RunReport& each : reports) {
    if (!has(each.transcript)) continue;
    if (first == nullptr) first = &each;
    if (each.transcript == first->transcript) continue;
    const std::string one = text_of(first->transcript);
    const std::string other = text_of(each.transcript);
    each.difference =
        first_difference({name_of_run(*first), one}, {name_of_run(each), other}, profile);
    return;
  }
}

}  // namespace xr3
