// Exported robots as values: joints, inertias, meshes, and both forms of a robot.
#include "tools/export/exported.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/models.hpp"
#include "tools/export/inertia.hpp"
#include "tools/export/joint.hpp"
#include "tools/export/numbers.hpp"
#include "tools/export/stl.hpp"

namespace xr3 {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kTiny = 1e-12;
constexpr double kRadian = kPi / 180;

ModelPtr shipped(const char* robot) { return test::model_of(test::robot_named(robot)); }

ExportedJoint joint_named(const Model& model, const std::string& name) {
  const std::vector<SceneLink> links = scene_links(model);
  for (std::size_t i = 0; i < links.size(); ++i)
    if (const auto joint = joint_of(model, links, i); joint && joint->name == name) return *joint;
  throw std::invalid_argument(name);
}

TEST(ExportedJoint, HasTheLimitsOfItsVariable) {
  const ExportedJoint shoulder = joint_named(*shipped("rhino-xr3"), "E");
  EXPECT_NEAR(shoulder.low, -140 * kRadian, kTiny);
  EXPECT_NEAR(shoulder.high, 10 * kRadian, kTiny);
  EXPECT_NEAR(shoulder.home, -90 * kRadian, kTiny);
  EXPECT_NEAR(shoulder.speed, 0.1135 * 110 * kRadian, kTiny);
  EXPECT_FALSE(shoulder.is_endless);
}

TEST(ExportedJoint, OfASlideIsInMetres) {
  const ExportedJoint slide = joint_named(*shipped("rhino-xr3-accessories"), "G");
  EXPECT_NEAR(slide.low, -0.25, kTiny);
  EXPECT_NEAR(slide.speed, 0.06, kTiny);
}

TEST(ExportedJoint, OfAFingerIsHalfTheOpening) {
  const ExportedJoint first = joint_named(*shipped("intelledex-660"), "A");
  const ExportedJoint second = joint_named(*shipped("intelledex-660"), "A_2");
  EXPECT_NEAR(first.high, 30 * kRadian, kTiny);
  EXPECT_NEAR(second.home, 20 * kRadian, kTiny);
  EXPECT_EQ(first.mimics, "");
  EXPECT_EQ(second.mimics, "A");
}

TEST(ExportedJoint, WithoutStopsIsEndless) {
  EXPECT_TRUE(joint_named(*shipped("rhino-xr3"), "B").is_endless);
  EXPECT_TRUE(joint_named(*shipped("rhino-xr3-accessories"), "H").is_endless);
  EXPECT_FALSE(joint_named(*shipped("intelledex-660"), "B").is_endless) << "360 degrees each way";
}

TEST(BoxInertia, IsThatOfTheBoxAroundTheSolid) {
  Solid solid;
  solid.faces = {
      {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(200, 100, 0), Eigen::Vector3d(200, 100, 300)}};
  const BoxInertia box = box_inertia(solid);
  EXPECT_EQ(box.center_mm, Eigen::Vector3d(100, 50, 150));
  EXPECT_NEAR(box.mass_kg, 0.2 * 0.1 * 0.3 * 300, kTiny);
  EXPECT_NEAR(box.moments.x(), box.mass_kg * (0.01 + 0.09) / 12, kTiny);
  EXPECT_NEAR(box.moments.z(), box.mass_kg * (0.04 + 0.01) / 12, kTiny);
}

TEST(BoxInertia, OfNoSolidIsPositive) {
  const BoxInertia box = box_inertia({});
  EXPECT_GT(box.mass_kg, 0);
  EXPECT_GT(box.moments.minCoeff(), 1e-9) << "it would be written as 0";
}

TEST(Stl, HasTrianglesWithNormalsInMetres) {
  const std::string bytes = to_stl(
      {{Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(1000, 0, 5), Eigen::Vector3d(0, 2000, 5)}});
  ASSERT_EQ(bytes.size(), 84U + 50);
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
  EXPECT_EQ(triangles, 1U);
  std::array<float, 12> numbers{};
  std::memcpy(numbers.data(), bytes.data() + 84, sizeof numbers);
  EXPECT_THAT(numbers, testing::ElementsAre(0, 0, 1, 0, 0, 0.005F, 1, 0, 0.005F, 0, 2, 0.005F));
}

TEST(Urdf, NamesItsMeshesAndEscapesItsName) {
  const std::vector<ExportedFile> files = to_urdf(*shipped("rhino-xr3-accessories"), "a \"<\" b");
  EXPECT_EQ(files[0].path, "a \"<\" b.urdf");
  EXPECT_THAT(files[0].bytes, HasSubstr("<robot name=\"a &quot;&lt;&quot; b\">"));
  ASSERT_EQ(files.size(), 1U + 10) << "base, six joints, two fingers, carousel";
  for (std::size_t i = 1; i < files.size(); ++i)
    EXPECT_THAT(files[0].bytes, HasSubstr("filename=\"" + files[i].path + "\"")) << i;
}

TEST(Urdf, HasOneRootAndItsFramesWithoutAMass) {
  const std::string text = to_urdf(*shipped("rhino-xr3"), "rhino")[0].bytes;
  EXPECT_THAT(text,
              AllOf(HasSubstr("  <link name=\"base\">\n    <visual>"),
                    HasSubstr("  <link name=\"tool\"/>"), Not(HasSubstr("child link=\"base\""))));
}

TEST(Urdf, PlacesAJointByTheRowBeforeIt) {
  EXPECT_THAT(to_urdf(*shipped("rhino-xr3"), "rhino")[0].bytes,
              HasSubstr("<child link=\"link_E\"/>\n"
                        "    <origin xyz=\"0 0 0.2604\" rpy=\"-1.570796326795 0 0\"/>\n"
                        "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"-2.443460952792\""));
}

TEST(Mjcf, BeginsAtTheSoftHomeWithAValueForEachJoint) {
  EXPECT_THAT(to_mjcf(*shipped("rhino-xr3"), "rhino")[0].bytes,
              AllOf(HasSubstr("qpos=\"0 -1.570796326795 1.570796326795 0 -1.570796326795 0.0254 "
                              "0.0254\""),
                    HasSubstr("ctrl=\"0 -1.570796326795 1.570796326795 0 -1.570796326795 "
                              "0.0254\"")));
}

TEST(Mjcf, KeepsTheSecondFingerEqual) {
  EXPECT_THAT(to_mjcf(*shipped("adept-one"), "adept")[0].bytes,
              AllOf(HasSubstr("<joint joint1=\"A_2\" joint2=\"A\" polycoef=\"0 1 0 0 0\""),
                    Not(HasSubstr("<position name=\"A_2\""))));
}

TEST(NumberText, KeepsPicometresAndIsNeverMinusZero) {
  EXPECT_EQ(number_text(-1e-15), "0");
  EXPECT_EQ(metres_text({228.6, -0.000000001, 0}), "0.2286 -0.000000000001 0");
  EXPECT_EQ(color_text(0), "0.169 0.188 0.212 1");
}

}  // namespace
}  // namespace xr3
