// Replies as bytes in both profiles.
#include "protocol/line/rhino_reply.hpp"

#include <gtest/gtest.h>

#include "tests/support/words.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

std::string encoded(const Reply& reply, Profile profile) {
  std::string bytes;
  append_reply(reply, profile, bytes);
  return bytes;
}

struct BytesOfReply {
  Reply reply;
  std::string_view paper;
  std::string_view mark3;
};

TEST(RhinoReply, HasTheseBytesInBothProfiles) {
  const BytesOfReply rows[] = {
      {NoReply{}, "", ""},
      {ErrorMagnitude{0}, " ", " "},
      {ErrorMagnitude{1}, "!", "!"},
      {ErrorMagnitude{50}, "R", "R"},
      {ErrorMagnitude{95}, "\x7f", "\x7f"},
      {ErrorMagnitude{96}, "\x80", "\0"sv},
      {ErrorMagnitude{127}, "\x9f", "\x1f"},
      {ErrorMagnitude{128}, "\xa0", " "},
      {SignedError{0}, "\0"sv, "\0"sv},
      {SignedError{5}, "\x05", "\x05"},
      {SignedError{-10}, "\xf6", "\xf6"},
      {SignedError{127}, "\x7f", "\x7f"},
      {SignedError{-128}, "\x80", "\x80"},
      {SwitchState{false}, "\0"sv, "\x01"},
      {SwitchState{true}, "\x01", "\0"sv},
      {PixelValue{false}, " ", " "},
      {PixelValue{true}, "!", "!"},
  };
  for (const BytesOfReply& row : rows) {
    EXPECT_EQ(encoded(row.reply, Profile::kPaper), row.paper) << test::words(row.reply);
    EXPECT_EQ(encoded(row.reply, Profile::kMark3), row.mark3) << test::words(row.reply);
  }
}

struct BitsRow {
  SwitchBits bits;
  int paper;
  int mark3;
};

// On the Rhino F E D C have bits 8 4 2 1 of I, B and A bits 2 1 of J.
TEST(RhinoReply, HasTheseSwitchBitsInBothProfiles) {
  const BitsRow rows[] = {
      {{0, 15, 0, 'I'}, 32, 95},   {{4, 15, 0, 'I'}, 36, 91}, {{15, 15, 0, 'I'}, 47, 80},
      {{0, 31, 0, 'I'}, 32, 95},   {{0, 0, 0, 'I'}, 32, 95},  {{0, 3, 0, 'J'}, 32, 35},
      {{2, 3, 0, 'J'}, 34, 33},    {{3, 3, 0, 'J'}, 35, 32},  {{1, 3, 0x3c, 'J'}, 93, 94},
      {{3, 3, 0x14, 'J'}, 55, 52}, {{0, 0, 0, 'K'}, 32, 32},  {{0, 0, 15, 'K'}, 47, 47},
      {{0, 0, 5, 'K'}, 37, 37},
  };
  for (const BitsRow& row : rows) {
    EXPECT_EQ(switch_code(row.bits, Profile::kPaper) + 32, row.paper)
        << test::words(Reply(row.bits));
    EXPECT_EQ(switch_code(row.bits, Profile::kMark3) + 32, row.mark3)
        << test::words(Reply(row.bits));
    EXPECT_EQ(encoded(row.bits, Profile::kPaper), std::string(1, static_cast<char>(row.paper)));
    EXPECT_EQ(encoded(row.bits, Profile::kMark3), std::string(1, static_cast<char>(row.mark3)));
  }
}

TEST(RhinoReply, ARowHasSixPixelsPerByteHighBitLeft) {
  const auto image = [](std::initializer_list<std::string_view> lines) {
    Image picture(static_cast<int>(lines.begin()->size()), static_cast<int>(lines.size()));
    int row = 0;
    for (const std::string_view line : lines) {
      for (int column = 0; column < picture.width(); ++column) {
        if (line[static_cast<std::size_t>(column)] == '1') picture.fill(row, column, column + 1);
      }
      ++row;
    }
    return CameraRows{std::make_shared<const Image>(picture)};
  };
  const std::pair<std::string_view, std::string_view> rows[] = {
      {"1111000001", "\\$"},  {"", ""},        {"0", " "},      {"1", "@"},
      {"000001", "!"},        {"100000", "@"}, {"111111", "_"}, {"1111111", "_@"},
      {"000000000000", "  "},
  };
  for (const auto& [pixels, bytes] : rows) {
    EXPECT_EQ(encoded(image({pixels}), Profile::kPaper), bytes) << pixels;
    EXPECT_EQ(encoded(image({pixels}), Profile::kMark3), bytes) << pixels;
  }
  EXPECT_EQ(encoded(image({"111111", "000001"}), Profile::kPaper), "_!");
}

TEST(RhinoReply, RowsOfEveryWidthHaveSixPixelsPerByte) {
  for (int width = 1; width < 200; ++width) {
    Image picture(width, 2);
    std::string pixels(static_cast<std::size_t>(width + 5) / 6 * 12, '0');
    for (int row = 0; row < 2; ++row) {
      for (int column = row; column < width; column += 1 + (column + width) % 5) {
        picture.fill(row, column, column + 1);
        pixels[static_cast<std::size_t>(column) + pixels.size() / 2 * static_cast<unsigned>(row)] =
            '1';
      }
    }
    std::string bytes;
    for (std::size_t i = 0; i < pixels.size(); i += 6)
      bytes += static_cast<char>(std::stoi(pixels.substr(i, 6), nullptr, 2) + kReplyBase);
    const Reply reply = CameraRows{std::make_shared<const Image>(picture)};
    EXPECT_EQ(encoded(reply, Profile::kPaper), bytes) << width;
  }
}

TEST(RhinoReply, IsAppendedToTheOutput) {
  std::string bytes = "x";
  append_reply(ErrorMagnitude{1}, Profile::kPaper, bytes);
  append_reply(NoReply{}, Profile::kPaper, bytes);
  append_reply(ErrorMagnitude{2}, Profile::kPaper, bytes);
  EXPECT_EQ(bytes, "x!\"");
}

}  // namespace
}  // namespace xr3
