#include "cell/transcript.hpp"

#include <gtest/gtest.h>

#include "core/home.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

/// The digest of the lines after some changes.
template <class Change>
std::string digest_after(const Change& change) {
  Transcript transcript;
  change(transcript);
  return transcript.summary().lines_digest;
}

TEST(Transcript, DependsOnEveryByteTickAndDirection) {
  const std::string one = digest_after([](Transcript& t) { t.add_in(1, 7, 'E'); });
  EXPECT_EQ(one, digest_after([](Transcript& t) { t.add_in(1, 7, 'E'); }));
  EXPECT_NE(one, digest_after([](Transcript& t) { t.add_in(1, 7, 'F'); }));
  EXPECT_NE(one, digest_after([](Transcript& t) { t.add_in(1, 8, 'E'); }));
  EXPECT_NE(one, digest_after([](Transcript& t) { t.add_out(1, 7, "E"); }));
  EXPECT_NE(one, digest_after([](Transcript& t) {
              t.add_in(1, 7, 'E');
              t.add_in(1, 7, 'E');
            }));
  EXPECT_NE(digest_after([](Transcript&) {}), one);
}

TEST(Transcript, HoldsNoNumbersOfLinesAndNoOrderOfTheirEnds) {
  const auto two = [](LineId a, LineId b, bool a_ends_first) {
    return digest_after([=](Transcript& t) {
      t.add_in(a, 1, 'a');
      t.add_in(b, 2, 'b');
      t.end_line(a_ends_first ? a : b);
      t.end_line(a_ends_first ? b : a);
    });
  };
  EXPECT_EQ(two(1, 2, true), two(1, 2, false));
  EXPECT_EQ(two(1, 2, true), two(5, 9, true));
  EXPECT_NE(two(1, 2, true), digest_after([](Transcript& t) {
              t.add_in(2, 1, 'b');
              t.add_in(1, 2, 'a');
            }));
}

TEST(Transcript, LinesWithoutBytesAreNotCounted) {
  Transcript transcript;
  transcript.end_line(1);
  transcript.add_out(2, 3, "");
  EXPECT_EQ(transcript.summary(), Transcript{}.summary());
  transcript.add_in(3, 1, 'E');
  transcript.add_out(3, 1, "abc");
  EXPECT_EQ(transcript.summary().lines, 1U);
  EXPECT_EQ(transcript.summary().bytes_in, 1U);
  EXPECT_EQ(transcript.summary().bytes_out, 3U);
}

TEST(Transcript, IsTheSameOpenOrClosed) {
  const auto with = [](bool ends) {
    return digest_after([ends](Transcript& t) {
      for (int i = 0; i < 5'000; ++i) t.add_in(1, i, 'x');
      if (ends) t.end_line(1);
    });
  };
  EXPECT_EQ(with(true), with(false));
}

TEST(Transcript, MarksAreKeptUntilTheNextEpoch) {
  Transcript transcript;
  transcript.mark(TranscriptMark::kSilence);
  transcript.mark(TranscriptMark::kArrivalOrder);
  transcript.mark(TranscriptMark::kSilence);
  EXPECT_EQ(transcript.summary().marks,
            (std::vector{TranscriptMark::kArrivalOrder, TranscriptMark::kSilence}));
  transcript.restart();
  EXPECT_EQ(transcript.summary(), Transcript{}.summary());
}

TEST(Transcript, ItsDigestCoversTheStateAtTheEnd) {
  const ModelPtr model = test::rhino();
  State state = initial_state(*model);
  const TranscriptSummary summary = Transcript{}.summary();
  const std::string first = transcript_digest(summary, *model, state, 0);
  EXPECT_EQ(first, transcript_digest(summary, *model, state, 0));
  EXPECT_NE(first, transcript_digest(summary, *model, state, 1)) << "the remainder";
  state.motor(0).count = 1;
  EXPECT_NE(first, transcript_digest(summary, *model, state, 0));
}

}  // namespace
}  // namespace xr3
