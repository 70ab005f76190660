// The camera's faults: offset, noise and dead rows, in the image, in rows and in pixels.
#include "core/faults/camera_faults.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>

#include "core/camera.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

Rig rig_with_camera(std::vector<Fault> faults, int columns = 192) {
  Workcell workcell = test::workcell_named("rhino-xr3");
  workcell.camera->pixels_x = columns;
  Rig rig(std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper));
  rig.simulation.install_faults({7, std::move(faults)});
  return rig;
}

Fault of_camera(FaultKind kind) {
  Fault fault;
  fault.name = "lens";
  fault.kind = kind;
  fault.from_tick = 0;
  return fault;
}

Fault offset(int columns, int rows) {
  Fault fault = of_camera(FaultKind::kCameraOffset);
  fault.columns = columns;
  fault.rows = rows;
  return fault;
}

Fault noise(std::uint32_t percent) {
  Fault fault = of_camera(FaultKind::kCameraNoise);
  fault.chance = percent * (kCertain / 100);
  return fault;
}

Fault dead_row(int row) {
  Fault fault = of_camera(FaultKind::kCameraDeadRow);
  fault.row = row;
  return fault;
}

bool at(const Image& image, int column, int row) {
  return column >= 0 && column < image.width() && row >= 0 && row < image.height() &&
         image.at(column, row);
}

int different_pixels(const Image& a, const Image& b) {
  int count = 0;
  for (int row = 0; row < a.height(); ++row) {
    for (std::size_t i = 0; i < a.words(row).size(); ++i)
      count += std::popcount(a.words(row)[i] ^ b.words(row)[i]);
  }
  return count;
}

RC_GTEST_PROP(CameraFaults, AnOffsetShiftsTheImage, ()) {
  const int columns = *rc::gen::inRange(-200, 200);
  const int rows = *rc::gen::inRange(-200, 200);
  Rig rig = rig_with_camera({offset(columns, rows)}, *rc::gen::inRange(1, 200));
  const Image clean = camera_image(rig.model(), rig.state());
  const ImagePtr seen = rig.simulation.camera_image();
  for (int row = 0; row < clean.height(); row += 3) {
    for (int column = 0; column < clean.width(); ++column)
      RC_ASSERT(seen->at(column, row) == at(clean, column - columns, row - rows));
  }
}

TEST(CameraFaults, NoiseInvertsPixelsAnewInEachTick) {
  Rig rig = rig_with_camera({noise(10)}, 150);
  const Image clean = camera_image(rig.model(), rig.state());
  const Image first = *rig.simulation.camera_image();
  EXPECT_NEAR(different_pixels(clean, first), 150 * 192 / 10, 200);
  EXPECT_EQ(first, *rig.simulation.camera_image());
  EXPECT_EQ(first.words(0).back() >> (150 % 64), 0U) << "no pixel beside the image";
  rig.pass(1);
  EXPECT_NEAR(different_pixels(first, *rig.simulation.camera_image()), 150 * 192 * 18 / 100, 400);
}

TEST(CameraFaults, ADeadRowIsDark) {
  Rig rig = rig_with_camera({dead_row(60)});
  const Image clean = camera_image(rig.model(), rig.state());
  const ImagePtr seen = rig.simulation.camera_image();
  for (int row = 0; row < 192; ++row) {
    const Image wanted = row == 60 ? Image(192, 1) : clean.row_image(row);
    EXPECT_EQ(seen->row_image(row), wanted) << row;
  }
}

TEST(CameraFaults, RowsAndPixelsAreThoseOfTheImage) {
  Rig rig = rig_with_camera({noise(20), offset(5, -9), dead_row(7)}, 100);
  rig.pass(10);
  const Image image = *rig.simulation.camera_image();
  for (const int row : {0, 7, 50, 191}) {
    EXPECT_EQ(rig.execute(CameraRow{row}),
              Reply(CameraRows{std::make_shared<const Image>(image.row_image(row))}));
    for (const int column : {0, 63, 64, 99})
      EXPECT_EQ(rig.execute(CameraPixel{column, row}), Reply(PixelValue{image.at(column, row)}));
  }
  EXPECT_EQ(rig.execute(CameraImage{}), Reply(CameraRows{std::make_shared<const Image>(image)}));
}

TEST(CameraFaults, AreGoneWhenTheyEnd) {
  Fault fault = noise(50);
  fault.ticks = 10;
  Rig rig = rig_with_camera({fault});
  EXPECT_NE(*rig.simulation.camera_image(), camera_image(rig.model(), rig.state()));
  rig.pass(10);
  EXPECT_EQ(*rig.simulation.camera_image(), camera_image(rig.model(), rig.state()));
}

TEST(CameraFaults, CountAnEffectForEachInquiryAndNoneForOthers) {
  Rig rig = rig_with_camera({dead_row(3)});
  rig.simulation.camera_image();
  rig.execute(QueryError{'E'});
  EXPECT_EQ(rig.state().faults.all[0].effects, 0U);
  rig.execute(CameraRow{3});
  rig.execute(CameraRow{500});
  EXPECT_EQ(rig.state().faults.all[0].effects, 1U);
}

}  // namespace
}  // namespace xr3
