// Blocks after they were placed: which of them float or overlap, and which only touch.
#include "core/placement.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/home.hpp"
#include "core/workcell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr Micrometres kSurface = 500'000;
constexpr Micrometres kTolerance = kContactToleranceUm;
constexpr PointUm kSize{60'000, 30'000, 40'000};

/// A block of 60 x 30 x 40 mm, `up` above the work surface.
Block block_at(std::string name, Micrometres x, Micrometres y, Micrometres up, double yaw_deg = 0) {
  return {std::move(name), kSize, {x, y, kSurface + up + kSize.z / 2}, microdegrees(yaw_deg), 1};
}

Block placed(Micrometres up, double yaw_deg = 0) {
  return block_at("placed", 300'000, 0, up, yaw_deg);
}

Block thin(std::string name, Micrometres up) {
  Block block = block_at(std::move(name), 300'000, 0, up);
  block.centroid_um.z += (1'000 - block.size_um.z) / 2;
  block.size_um.z = 1'000;
  return block;
}

struct Scene {
  Model model;
  State state;

  explicit Scene(std::vector<Block> blocks)
      : model(
            test::robot_named("rhino-xr3"),
            [&blocks] {
              Workcell workcell = test::bare_workcell();
              workcell.work_surface_um = kSurface;
              workcell.blocks = std::move(blocks);
              return workcell;
            }(),
            Profile::kPaper),
        state(initial_state(model)) {}

  std::vector<Warning> warnings(std::size_t block = 0) const {
    Events events;
    warn_of_placement(model, state, block, events);
    return bodies(events);
  }
  std::vector<Warning> overlap_warnings(std::size_t block = 0) const {
    Events events;
    warn_of_overlap(model, state, block, events);
    return bodies(events);
  }

 private:
  static std::vector<Warning> bodies(const Events& events) {
    std::vector<Warning> warnings;
    for (const Event& event : events) warnings.push_back(std::get<Warning>(event.body));
    return warnings;
  }
};

Warning in_air(int gap_um, std::string support = "") {
  return {WarningCode::kReleasedInAir, 'A', gap_um, 0, "placed", std::move(support)};
}
Warning overlaps(int count, std::string first) {
  return {WarningCode::kBlocksOverlap, 'A', count, 0, "placed", std::move(first)};
}

struct PlacementCase {
  const char* what;
  std::vector<Block> blocks;  ///< the first one was placed
  std::vector<Warning> warnings;
};

void check(const PlacementCase& c) { EXPECT_EQ(Scene(c.blocks).warnings(), c.warnings) << c.what; }

TEST(Placement, ABlockStandsOnTheSurfaceOrFloatsAboveIt) {
  const PlacementCase cases[] = {
      {"on the surface", {placed(0)}, {}},
      {"as far above it as is tolerated", {placed(kTolerance)}, {}},
      {"a micrometre more", {placed(kTolerance + 1)}, {in_air(kTolerance + 1)}},
      {"far above it", {placed(80'302, 33)}, {in_air(80'302)}},
      {"below the surface", {placed(-10'000)}, {}},
      {"far above it, beside a higher block",
       {placed(30'000), block_at("other", 360'000, 0, 20'000)},
       {in_air(30'000)}},
      {"below another one", {placed(0), block_at("other", 300'000, 0, 40'000)}, {}},
  };
  for (const PlacementCase& c : cases) check(c);
}

TEST(Placement, ABlockStandsOnTheHighestBlockBelowIt) {
  const Block lower = block_at("lower", 300'000, 0, 0);
  const PlacementCase cases[] = {
      {"stacked", {placed(40'000), lower}, {}},
      {"stacked and turned", {placed(40'000, 45), lower}, {}},
      {"stacked with a gap", {placed(40'000 + kTolerance), lower}, {}},
      {"above it", {placed(40'000 + kTolerance + 1), lower}, {in_air(kTolerance + 1, "lower")}},
      {"over its edge",
       {placed(70'000), block_at("lower", 359'999, 0, 0)},
       {in_air(30'000, "lower")}},
      {"beside it", {placed(70'000), block_at("lower", 360'000, 0, 0)}, {in_air(70'000)}},
      {"above two", {placed(85'000), lower, thin("upper", 40'000)}, {in_air(44'000, "upper")}},
      {"above two in the other order",
       {placed(85'000), thin("upper", 40'000), lower},
       {in_air(44'000, "upper")}},
  };
  for (const PlacementCase& c : cases) check(c);
}

TEST(Placement, BlocksThatTouchDoNotOverlap) {
  const PlacementCase cases[] = {
      {"side by side", {placed(0), block_at("other", 300'000, 30'000, 0)}, {}},
      {"end to end", {placed(0), block_at("other", 360'000, 0, 0)}, {}},
      {"side by side, turned by 30 degrees",
       {placed(0, 30), block_at("other", 285'000, 25'981, 0, 30)},
       {}},
      {"an end at a side", {placed(0), block_at("other", 300'000, 45'000, 0, 90)}, {}},
      {"only the bounding boxes overlap",
       {placed(0, 45), block_at("other", 345'000, -45'000, 0, -45)},
       {}},
      {"as deep at the side as is tolerated",
       {placed(0), block_at("other", 300'000, 30'000 - kTolerance, 0)},
       {}},
      {"pressed as deep into the lower one as is tolerated",
       {placed(40'000 - kTolerance), block_at("other", 300'000, 0, 0)},
       {}},
  };
  for (const PlacementCase& c : cases) check(c);
}

TEST(Placement, BlocksThatShareSpaceOverlap) {
  const PlacementCase cases[] = {
      {"a micrometre too deep at the side",
       {placed(0), block_at("other", 300'000, 30'000 - kTolerance - 1, 0)},
       {overlaps(1, "other")}},
      {"a micrometre too deep into the lower one: it stands on that one",
       {placed(40'000 - kTolerance - 1), block_at("other", 300'000, 0, 0)},
       {overlaps(1, "other")}},
      {"at the same place", {placed(0), block_at("other", 300'000, 0, 0)}, {overlaps(1, "other")}},
      {"crossed", {placed(0, 45), block_at("other", 300'000, 0, 0, -45)}, {overlaps(1, "other")}},
      {"a corner in a side",
       {placed(0), block_at("other", 300'000, 40'000, 0, 45)},
       {overlaps(1, "other")}},
      {"one inside the other", {placed(0), thin("other", 20'000)}, {overlaps(1, "other")}},
      {"in the air: reported as an overlap",
       {placed(90'000), block_at("other", 300'000, 0, 90'000)},
       {overlaps(1, "other")}},
      {"two of three",
       {placed(0), block_at("apart", 400'000, 0, 0), block_at("first", 340'000, 0, 0),
        block_at("second", 260'000, 0, 0)},
       {overlaps(2, "first")}},
  };
  for (const PlacementCase& c : cases) {
    check(c);
    EXPECT_EQ(Scene(c.blocks).overlap_warnings(), c.warnings) << c.what;
  }
}

TEST(Placement, FloatingIsNoOverlap) {
  EXPECT_TRUE(Scene({placed(80'000)}).overlap_warnings().empty());
}

TEST(Placement, AHeldBlockIsNotWhereItWasGrasped) {
  Scene scene(
      {placed(40'000), block_at("held", 300'000, 0, 0), block_at("too", 310'000, 0, 40'000)});
  EXPECT_EQ(scene.warnings(), (std::vector{overlaps(1, "too")}));
  scene.state.held = Held{2, 0, {}};
  EXPECT_TRUE(scene.warnings().empty());
  scene.state.held = Held{1, 0, {}};
  scene.state.blocks.edit().pop_back();
  EXPECT_EQ(scene.warnings(), (std::vector{in_air(40'000)}));
}

TEST(Placement, TheOverlapOfFootprintsIsTheShortestWayOut) {
  const Block a = placed(0, 17);
  EXPECT_EQ(footprint_overlap_um(a, a), 30'000);
  Block b = placed(0, 107);
  EXPECT_EQ(footprint_overlap_um(a, b), 45'000);
  EXPECT_EQ(footprint_overlap_um(b, a), 45'000);
  b.centroid_um.x += 200'000;
  EXPECT_LT(footprint_overlap_um(a, b), 0);
}

}  // namespace
}  // namespace xr3
