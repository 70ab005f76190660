// The members of `image` messages, in both encodings.
#include "protocol/monitor/image.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace xr3 {
namespace {

using monitor::Encoding;

Image image_of(const std::vector<std::string>& rows) {
  Image image(static_cast<int>(rows.at(0).size()), static_cast<int>(rows.size()));
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      const bool is_set =
          rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '1';
      if (is_set) image.fill(row, column, column + 1);
    }
  }
  return image;
}

const std::vector<std::string> kPicture = {"00000000", "00110000", "00111100",
                                           "00001100", "00000000", "00000001"};

TEST(ImageJson, Rows) {
  EXPECT_EQ(image_json(image_of(kPicture), Encoding::kRows).dump(),
            R"({"width":8,"height":6,"encoding":"rows","rows":["00000000","00110000","00111100",)"
            R"("00001100","00000000","00000001"]})");
}

TEST(ImageJson, RunLengthsBeginWithZeroPixels) {
  EXPECT_EQ(image_json(image_of(kPicture), Encoding::kRle).dump(),
            R"({"width":8,"height":6,"encoding":"rle",)"
            R"("rows":[[8],[2,2,4],[2,4,2],[4,2,2],[8],[7,1]]})");
  EXPECT_EQ(image_json(image_of({"1111", "1001"}), Encoding::kRle)["rows"].dump(),
            "[[0,4],[0,1,2,1]]");
}

void expect_the_same_text(const Image& image) {
  for (const Encoding encoding : {Encoding::kRows, Encoding::kRle}) {
    EXPECT_EQ(image_text(image, encoding), image_json(image, encoding).dump());
  }
}

TEST(ImageJson, TheFastTextEqualsTheJson) {
  expect_the_same_text(image_of(kPicture));
  expect_the_same_text(image_of({"1"}));
  expect_the_same_text(Image(70, 0));
  expect_the_same_text(Image(0, 2));
}

std::string unpacked(const Json& runs) {
  std::string text;
  char pixel = '0';
  for (const Json& run : runs) {
    text.append(run.get<std::size_t>(), pixel);
    pixel = pixel == '0' ? '1' : '0';
  }
  return text;
}

// Widths around the word size of a row's storage; short and long runs, of which only the first may
// be empty.
TEST(ImageJson, BothEncodingsContainEveryPixel) {
  std::mt19937 random(1);
  for (const int width : {1, 7, 8, 63, 64, 65, 127, 128, 129, 300}) {
    for (int round = 0; round < 20; ++round) {
      std::string row;
      while (row.size() < static_cast<std::size_t>(width)) {
        row.append(1 + random() % (round % 2 == 0 ? 3U : 90U), random() % 2 == 0 ? '0' : '1');
      }
      row.resize(static_cast<std::size_t>(width));
      const Image image = image_of({row});
      EXPECT_EQ(image_json(image, Encoding::kRows)["rows"][0], row);
      expect_the_same_text(image);
      const Json runs = image_json(image, Encoding::kRle)["rows"][0];
      EXPECT_EQ(unpacked(runs), row);
      for (std::size_t i = 1; i < runs.size(); ++i) EXPECT_GT(runs[i], 0);
    }
  }
}

}  // namespace
}  // namespace xr3
