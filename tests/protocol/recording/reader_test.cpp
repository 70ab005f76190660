#include "protocol/recording/reader.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3::recording {
namespace {

Header small_header() {
  Header header;
  header.program = "xr3 test";
  header.state_format = 1;
  header.cell = "main";
  header.model = test::rhino();
  return header;
}

/// A recording of five lines.
std::string small_recording() {
  RecordingWriter writer;
  std::string text = writer.line(small_header());
  text += writer.line({0, 0, 0, LineBegin{1, "a", LineKind::kTcp, Guard::kNormal}});
  text += writer.line({0, 20, 0, LineInput{1, "A?", 2, 0, " "}});
  text += writer.line({1, 0, 0, LineInput{1, "A?", 2, 0, "\xff"}});
  return text + writer.line({1, 9, 0, End{"sha256:1", "stopped"}});
}

/// Positions in a recording that are tried. (Each try reads the robot in the first line.)
constexpr std::size_t kStride = 3;

struct ReadAll {
  std::size_t entries = 0;
  std::size_t cut_off = 0;
  bool is_whole = false;
  std::string error;
  int error_line = 0;
};

ReadAll read_recording(std::string_view text, std::size_t piece = 1 << 20) {
  ReadAll all;
  RecordingReader reader("file");
  try {
    bool has_header = false;
    for (std::size_t at = 0;; at += piece) {
      const bool is_end = at >= text.size();
      is_end ? reader.end() : reader.add(text.substr(at, piece));
      if (!has_header) has_header = reader.header().has_value();
      while (has_header && reader.next()) ++all.entries;
      if (is_end) break;
    }
    all.cut_off = reader.cut_off();
    all.is_whole = reader.is_whole();
  } catch (const DataError& error) {
    all.error = to_text(error.findings());
    all.error_line = error.findings().front().line;
  }
  return all;
}

int line_at(const std::string& text, std::size_t position) {
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + std::ptrdiff_t(position), '\n'));
}

TEST(RecordingReader, ReadsWhatTheWriterWritesInAnyPieces) {
  const std::string text = small_recording();
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{100'000}}) {
    const ReadAll all = read_recording(text, piece);
    EXPECT_EQ(all.error, "");
    EXPECT_EQ(all.entries, 4U);
    EXPECT_TRUE(all.is_whole);
    EXPECT_EQ(all.cut_off, 0U);
  }
}

TEST(RecordingReader, AChangedByteIsFoundInItsLine) {
  const std::string text = small_recording();
  for (std::size_t at = 0; at < text.size(); at += kStride) {
    for (const char other : {'\n', static_cast<char>(text[at] ^ 1)}) {
      if (text[at] == other) continue;
      std::string changed = text;
      changed[at] = other;
      const ReadAll all = read_recording(changed);
      ASSERT_NE(all.error, "") << "byte " << at;
      ASSERT_EQ(all.error_line, line_at(text, at)) << all.error;
    }
    if (at > 30 && at + 400 < text.size()) at += 300;  // the long first line
  }
}

TEST(RecordingReader, LostAndMovedLinesAreFound) {
  const std::string text = small_recording();
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  EXPECT_EQ(read_recording(lines[0] + lines[1] + lines[3]).error_line, 3);
  EXPECT_EQ(read_recording(lines[0] + lines[2] + lines[1]).error_line, 2);
  EXPECT_EQ(read_recording(lines[0] + lines[1] + lines[1]).error_line, 3);
  EXPECT_EQ(read_recording(text + lines[4]).error_line, 6);
}

TEST(RecordingReader, ARecordingThatIsCutOffEndsWithItsLastWholeLine) {
  const std::string text = small_recording();
  const std::size_t first = text.find('\n') + 1;
  for (std::size_t size = first; size < text.size(); size += kStride) {
    const ReadAll all = read_recording(std::string_view(text).substr(0, size));
    ASSERT_EQ(all.error, "") << size;
    ASSERT_FALSE(all.is_whole);
    ASSERT_EQ(all.entries + 1, static_cast<std::size_t>(line_at(text, size)) - 1);
    ASSERT_EQ(all.cut_off == 0, text[size - 1] == '\n');
  }
}

TEST(RecordingReader, RefusesOtherFilesAndOtherFormats) {
  EXPECT_NE(read_recording("hello\n").error.find("a recording made by"), std::string::npos);
  EXPECT_NE(read_recording(R"({"robot":1})"
                           "\n")
                .error.find("a recording made by"),
            std::string::npos);
  EXPECT_NE(read_recording(R"({"xr3_recording":2})"
                           "\n")
                .error.find("format 2"),
            std::string::npos);
  EXPECT_EQ(read_recording("").entries, 0U);
}

TEST(RecordingReader, LinesAreBounded) {
  RecordingWriter writer;
  std::string text = writer.line(small_header()) + "{\"tick\":1,\"line\":1,\"in\":\"";
  text.append(kMaxLine, 'x');
  EXPECT_EQ(read_recording(text, 65536).error_line, 2);
}

TEST(RecordingReader, ErrorsHaveLineAndPointer) {
  RecordingWriter writer;
  std::string text = writer.line(small_header());
  text += writer.line({0, 0, 0, CallMade{call::SetInput{9, true}}});
  const ReadAll all = read_recording(text);
  EXPECT_EQ(all.error, "file:2: /args/input: found 9; allowed: a whole number 1...8\n");
}

}  // namespace
}  // namespace xr3::recording
