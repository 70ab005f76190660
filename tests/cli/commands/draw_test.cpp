// `xr3 draw`: parsing of poses, rasterization of lines, and files that other programs can read.
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "cli/commands/commands.hpp"
#include "cli/options/pose_argument.hpp"
#include "core/coupling.hpp"
#include "server/files/data_files.hpp"
#include "server/files/png.hpp"
#include "tests/support/rig.hpp"
#include "tools/drawing/view_vector.hpp"

namespace xr3 {
namespace {

using test::positions_at;
using test::rhino;

// --- Poses.

TEST(PoseArgument, NumbersAreSeparatedByCommas) {
  EXPECT_EQ(parse_numbers("0,-39.5, 110"), (std::vector<double>{0, -39.5, 110}));
  for (const char* wrong : {"", ",", "1,", "1,,2", "1;2", "1,x", "1 2", "nan", "inf", "1e999"}) {
    EXPECT_THROW(parse_numbers(wrong), std::invalid_argument) << wrong;
  }
}

TEST(PoseArgument, ValuesAreRoundedToCounts) {
  const Positions wanted =
      pose_argument(*rhino(), {0, -39.0385, 109.976, -70.9375, -90}, std::nullopt);
  EXPECT_EQ(motor_counts(*rhino(), wanted), (Positions{0, 449, -625, 0, 0, 0}));
  EXPECT_EQ(pose_argument(*rhino(), {}, 63.5), (Positions{0, 0, 0, 0, 0, -16}));
  EXPECT_EQ(pose_argument(*rhino(), {}, std::nullopt), Positions{});
}

TEST(PoseArgument, AcceptsTheLimits) {
  EXPECT_EQ(pose_argument(*rhino(), {175, 10, -15, 125, 0}, 0),
            (Positions{rhino()->motor(0).high, rhino()->motor(1).high, rhino()->motor(2).high,
                       rhino()->motor(3).low, 288, 64}));
}

void expect_refused(const std::vector<double>& joints, std::optional<double> tool,
                    const std::string& words) {
  try {
    pose_argument(*rhino(), joints, tool);
    ADD_FAILURE() << "not refused; expected: " << words;
  } catch (const ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(PoseArgument, ReportsWhyAPoseIsInvalid) {
  expect_refused({0, 10.1, 90, 0, 0}, {},
                 "joint E (shoulder) cannot be at 10.1; it goes from -140 to 10 degrees");
  expect_refused({}, 63.6, "the tool cannot be at 63.6; it goes from 0 to 63.5 mm");
  expect_refused({1, 2}, {}, "2 joint values are given; Rhino XR-3 has 5: joint F (base), ");
}

TEST(PoseArgument, AViewIsThreeSmallIntegers) {
  EXPECT_EQ(parse_view("-9,0,3"), (ViewVector{-9, 0, 3}));
  for (const char* wrong :
       {"0,0,0", "1,1", "1,1,1,1", "10,0,0", "-10,0,0", "1,1,0.5", "1e99,0,1"}) {
    EXPECT_THROW(parse_view(wrong), std::invalid_argument) << wrong;
  }
}

// --- Pixels.

Rgb at(const Raster& raster, int x, int y) {
  return raster.pixels[static_cast<std::size_t>(y * raster.width_px + x)];
}

Picture sheet(std::vector<FlatWire> wires) {
  return {20, 10, Background::kLight, "", std::move(wires)};
}

constexpr Rgb kWhite{255, 255, 255};

TEST(Raster, ALineCoversItsPixels) {
  const Raster raster =
      rasterized(sheet({{"base", 0, {{2, 4.5}, {12, 4.5}}}}));  // 1.4 px wide, black
  EXPECT_EQ(raster.pixels.size(), 200u);
  EXPECT_EQ(at(raster, 5, 4), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(raster, 5, 3), (Rgb{204, 204, 204})) << "a fifth is covered";
  EXPECT_EQ(at(raster, 5, 5), at(raster, 5, 3));
  EXPECT_EQ(at(raster, 5, 2), kWhite);
  EXPECT_EQ(at(raster, 0, 4), kWhite);
  EXPECT_EQ(at(raster, 14, 4), kWhite);
}

TEST(Raster, APolylineIsNotDarkerAtItsCorners) {
  const Raster once = rasterized(sheet({{"base", 0, {{2, 4}, {12, 4}}}}));
  const Raster twice = rasterized(sheet({{"base", 0, {{2, 4}, {12, 4}, {2, 4}}}}));
  EXPECT_EQ(once.pixels, twice.pixels);
}

TEST(Raster, ClipsLinesAtTheEdge) {
  const Raster raster = rasterized(
      sheet({{"base", 0, {{-1e6, 4.5}, {1e6, 4.5}}}, {"base", 0, {{30, -5}, {1e9, -1e9}}}}));
  EXPECT_EQ(at(raster, 0, 4), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(raster, 19, 4), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(raster, 19, 0), kWhite);
}

// --- Files.

Raster read_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  image.format = PNG_FORMAT_RGB;
  Raster raster{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  raster.pixels.resize(std::size_t{image.width} * image.height);
  EXPECT_NE(png_image_finish_read(&image, nullptr, raster.pixels.data(), 0, nullptr), 0);
  return raster;
}

TEST(Png, LibpngReadsTheSamePixels) {
  const Raster raster = rasterized(sheet({{"base", 12, {{1, 1}, {18, 8}}}}));
  const Raster read = read_png(to_png(raster));
  EXPECT_EQ(read.width_px, 20);
  EXPECT_EQ(read.height_px, 10);
  EXPECT_EQ(read.pixels, raster.pixels);
}

class Draw : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("XR3_DATA", XR3_SOURCE_DIR "/data", 1);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    ::unsetenv("XR3_DATA");
  }

  std::string drawn(const std::string& name, DrawOptions options) {
    options.out = folder_ / name;
    EXPECT_EQ(run_command(options), ExitCode::kGood);
    return read_file(options.out).text;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("xr3-draw-" + std::to_string(::getpid()));
};

TEST_F(Draw, WritesEachRobotAsSvgAndPng) {
  for (const char* robot : {"rhino-xr3", "adept-one", "intelledex-660"}) {
    DrawOptions options;
    options.robot = robot;
    options.width_px = 300;
    const std::string svg = drawn("a.svg", options);
    EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    for (const char* part : {"surface", "base", "tool", "finger+1", "finger-1", "block:red"}) {
      EXPECT_NE(svg.find("data-part=\"" + std::string(part) + "\""), std::string::npos) << part;
    }
    const Raster raster = read_png(drawn("a.png", options));
    EXPECT_EQ(raster.width_px, 300);
    EXPECT_NE(svg.find("height=\"" + std::to_string(raster.height_px) + "\""), std::string::npos);
    EXPECT_GT(std::count_if(raster.pixels.begin(), raster.pixels.end(),
                            [](const Rgb& pixel) { return pixel != kWhite; }),
              1000);
  }
}

TEST_F(Draw, ShowsTheGivenPoseAndView) {
  const std::string home = drawn("home.svg", {});
  EXPECT_NE(home.find("<title>Rhino XR-3 seen from (1, 1, 1)</title>"), std::string::npos);
  DrawOptions open;
  open.tool = 10;
  EXPECT_NE(drawn("open.svg", open), home);
  DrawOptions turned;
  turned.joints = {30, -90, 90, 0, -90};
  EXPECT_NE(drawn("turned.svg", turned), home);
  DrawOptions above;
  above.view = {0, 0, 1};
  EXPECT_NE(drawn("above.svg", above).find("seen from (0, 0, 1)"), std::string::npos);
}

TEST_F(Draw, ThrowsIfItCannotWrite) {
  DrawOptions options;
  options.out = "/nonexistent/folder/a.svg";
  EXPECT_THROW(run_command(options), FileError);
}

}  // namespace
}  // namespace xr3
