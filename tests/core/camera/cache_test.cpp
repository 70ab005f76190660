// The cached camera image equals a new one, and is rendered only when it must be.
#include "core/camera/cache.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/camera.hpp"
#include "core/home.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

/// The counts with the Rhino's open jaws around the first block of its workcell.
constexpr std::initializer_list<test::LabelledCount> kAtABlock = {
    {'E', 449}, {'D', -625}, {'A', -16}};

ModelPtr rhino_with(const Workcell& workcell) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper);
}

ModelPtr rhino_with_blocks() { return rhino_with(test::workcell_named("rhino-xr3")); }

Rig rig_at_a_block() {
  Rig rig(rhino_with_blocks());
  rig.stand_at(kAtABlock);
  return rig;
}

/// The image, a row and a pixel equal those without a cache.
void expect_fresh(Rig& rig, int column, int row) {
  const Image fresh = camera_image(rig.model(), rig.state());
  RC_ASSERT(rig.execute(CameraPixel{column, row}) == Reply(PixelValue{fresh.at(column, row)}));
  RC_ASSERT(rig.execute(CameraRow{row}) ==
            Reply(CameraRows{std::make_shared<const Image>(fresh.row_image(row))}));
  RC_ASSERT(rig.execute(CameraImage{}) == Reply(CameraRows{std::make_shared<const Image>(fresh)}));
}

// --- The kept picture is the fresh one.

int any(int low, int high) { return *rc::gen::inRange(low, high + 1); }

Workcell another_workcell() {
  Workcell workcell = test::workcell_named(*rc::gen::element("rhino-xr3", "rhino-hundred"));
  switch (any(0, 4)) {
    case 0: workcell.camera->projection = Projection::kPerspective; break;
    case 1: workcell.camera->location_um.x += 50'000; break;
    case 2: workcell.camera->pixels_x = 100; break;
    case 3: workcell.work_surface_um -= 40'000; break;
    default: break;
  }
  return workcell;
}

/// Moves a block that is not held a little, turns it, makes it smaller or takes it away.
void edit(Rig& rig) {
  State& state = rig.simulation.edit();
  const auto block = static_cast<std::size_t>(any(0, 99)) % state.blocks.size();
  if (state.held && state.held->block == block) return;
  Block& changed = state.blocks.edit()[block];
  switch (any(0, 4)) {
    case 0: changed.centroid_um.x += 10'000; break;
    case 1: changed.centroid_um.z += 10'000; break;
    case 2: changed.yaw_udeg += 30'000'000; break;
    case 3: changed.size_um.y += 5'000; break;
    default:
      if (state.blocks.size() > 1) remove_block(rig.model(), state, block);
  }
}

/// Changes the machine at random, as between two inquiries; a restore brings back `saved`.
void something_happens(Rig& rig, State& saved) {
  switch (any(0, 11)) {
    case 0: rig.move('A', 100); return rig.pass(any(1, 3000));
    case 1:
      rig.execute(Stop{'A'});
      rig.move('A', -any(1, 60));
      return rig.pass(any(1, 1000));
    case 2:
    case 3:
    case 4:
      rig.move(*rc::gen::element('B', 'C', 'D', 'E', 'F'), any(-9, 9));
      return rig.pass(any(1, 99));
    case 5: return rig.simulation.run_to_rest(rig.state().tick + any(1, 999));
    case 6: return edit(rig);
    case 7: saved = rig.state(); return;
    case 8: return rig.simulation.restore(saved);
    case 9:
      if (any(0, 9) == 0) rig.execute(SoftHome{});
      return;
    case 10:
      if (any(0, 9) == 0) rig.simulation.reset();
      return;
    default: return rig.stand_at(kAtABlock);
  }
}

RC_GTEST_PROP(CameraCache, AnswersEqualThoseWithoutACache, ()) {
  Rig rig = rig_at_a_block();
  State saved = rig.state();
  for (int i = any(1, 60); i > 0; --i) {
    if (any(0, 9) == 0) {
      rig.simulation.replace_workcell(rhino_with(another_workcell()));
      saved = rig.state();
    } else {
      something_happens(rig, saved);
    }
    if (any(0, 3) > 0) expect_fresh(rig, any(0, 99), any(0, 191));
  }
}

TEST(CameraCache, ImagesFollowAGraspedCarriedAndReleasedBlock) {
  Rig rig = rig_at_a_block();
  const auto is_fresh = [&rig] {
    return *rig.simulation.camera_image() == camera_image(rig.model(), rig.state());
  };
  EXPECT_TRUE(is_fresh());
  rig.move('A', 100);
  for (int i = 0; i < 1000 && !rig.state().held; ++i) {
    rig.pass(1);
    ASSERT_TRUE(is_fresh()) << "while the jaws close, tick " << i;
  }
  ASSERT_TRUE(rig.state().held);
  rig.execute(Stop{'A'});
  rig.move('E', -100);
  rig.move('F', 50);
  for (int i = 0; i < 1000; ++i) {
    rig.pass(1);
    ASSERT_TRUE(is_fresh()) << "carried, tick " << i;
  }
  rig.move('A', -5);
  rig.settle();
  EXPECT_FALSE(rig.state().held);
  EXPECT_TRUE(is_fresh());
}

// --- It is made once.

TEST(CameraCache, RendersAStateOnceForAHundredImages) {
  Rig rig(rhino_with_blocks());
  for (int i = 0; i < 100; ++i) {
    rig.execute(CameraImage{});
    rig.execute(CameraRow{i});
    rig.execute(CameraPixel{i, 7});
  }
  EXPECT_EQ(rig.simulation.camera().renders(), 1U);
}

TEST(CameraCache, InvisibleChangesCauseNoRendering) {
  Rig rig(rhino_with_blocks());
  const ImagePtr before = rig.simulation.camera_image();
  rig.move('F', 100);
  rig.execute(ToggleErasing{});
  rig.simulation.set_input(3, true);
  rig.pass(5000);
  EXPECT_EQ(rig.simulation.camera_image(), before);
  EXPECT_EQ(rig.simulation.camera().renders(), 1U);
}

TEST(CameraCache, ACarriedBlockIsDrawnOverTheOthers) {
  Rig rig = rig_at_a_block();
  rig.move('A', 100);
  rig.settle();
  ASSERT_TRUE(rig.state().held);
  const ImagePtr before = rig.simulation.camera_image();
  const std::uint64_t renders = rig.simulation.camera().renders();
  rig.move('F', 1);
  rig.settle();
  EXPECT_NE(*rig.simulation.camera_image(), *before);
  EXPECT_EQ(rig.simulation.camera().renders(), renders + 1);
}

TEST(CameraCache, TheFirstInquiriesRenderOnlyTheirRow) {
  Rig rig(rhino_with_blocks());
  for (int i = 0; i < 100; ++i) rig.execute(CameraRow{i});
  EXPECT_EQ(rig.simulation.camera().renders(), 3U) << "two rows, and then the image";
}

TEST(CameraCache, ACachedImageIsNotPartOfTheState) {
  Rig rig(rhino_with_blocks());
  const State before = rig.state();
  rig.execute(CameraImage{});
  EXPECT_EQ(rig.state(), before);
}

TEST(CameraCache, WithoutACameraThereIsNoImage) {
  Rig rig;
  EXPECT_EQ(rig.simulation.camera_image(), nullptr);
}

}  // namespace
}  // namespace xr3
