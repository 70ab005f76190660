// The transcripts of repeated runs, and the comparison of two of them.
#include "cli/exec/kept_transcripts.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace xr3 {
namespace {

std::vector<RunReport> reports_with(std::initializer_list<const char*> digests) {
  std::vector<RunReport> reports;
  for (const char* each : digests) {
    reports.emplace_back().transcript = each;
    reports.back().run = reports.size();
  }
  return reports;
}

TEST(KeptTranscripts, TheFirstRunThatDiffersIsCompared) {
  const KeptTranscripts kept;
  kept.keep("sha256:a", "0 1 > F+1\\r\n");
  kept.keep("sha256:a", "0 1 > F+1\\r\n");
  kept.keep("sha256:b", "0 1 > F+2\\r\n");
  std::vector<RunReport> reports = reports_with({"sha256:a", "sha256:a", "sha256:b", "sha256:b"});
  kept.compare(reports, Profile::kPaper);
  EXPECT_TRUE(reports[2].difference.starts_with("run 1 and run 3 differ first on line 1"));
  for (const std::size_t i : {0U, 1U, 3U}) EXPECT_EQ(reports[i].difference, "");
}

TEST(KeptTranscripts, TwoAreEnough) {
  const KeptTranscripts kept;
  for (const char* each : {"sha256:a", "sha256:b", "sha256:c"}) kept.keep(each, "");
  std::vector<RunReport> reports = reports_with({"sha256:c", "sha256:b", "sha256:a"});
  kept.compare(reports, Profile::kPaper);
  EXPECT_EQ(reports[1].difference, "");
  EXPECT_TRUE(reports[2].difference.starts_with("run 2 and run 3 have the same bytes"));
}

TEST(KeptTranscripts, RunsWithoutADigestAreNotCompared) {
  const KeptTranscripts kept;
  kept.keep("", "0 1 > F+1\\r\n");
  std::vector<RunReport> reports = reports_with({"", ""});
  kept.compare(reports, Profile::kPaper);
  EXPECT_EQ(reports[1].difference, "");
}

}  // namespace
}  // namespace xr3
