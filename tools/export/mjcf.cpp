#include <Eigen/Geometry>

#include "tools/export/exported.hpp"
#include "tools/export/inertia.hpp"
#include "tools/export/joint.hpp"
#include "tools/export/numbers.hpp"
#include "tools/export/stl.hpp"
#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

/// Armature and damping stand for geared motors; without them a light arm is unstable. Solids do
/// not touch each other, since neighbours overlap.
constexpr const char* kOptions = R"(  <!-- Made by xr3 export, in metres and radians.
       Masses, inertias and actuators are guesses. -->
  <compiler angle="radian"/>
  <option integrator="implicit"/>
  <default>
    <joint armature="1" damping="100"/>
    <geom contype="0" conaffinity="0"/>
    <position kp="2000"/>
  </default>
)";

/// Writes the sections of the file, in one walk over the links.
class MjcfWriter {
 public:
  MjcfWriter(const Model& model, const std::vector<SceneLink>& links)
      : model_(model), links_(links) {}

  std::string text(const std::string& name) {
    add_body(0, "    ");
    return "<mujoco model=\"" + xml(name) + "\">\n" + kOptions + "  <asset>\n" + assets_ +
           "  </asset>\n  <worldbody>\n    <light pos=\"0 0 3\"/>\n" + bodies_ +
           "  </worldbody>\n  <equality>\n" + equalities_ + "  </equality>\n  <actuator>\n" +
           actuators_ + "  </actuator>\n  <keyframe>\n    <key name=\"home\" qpos=\"" + positions_ +
           "\" ctrl=\"" + controls_ + "\"/>\n  </keyframe>\n</mujoco>\n";
  }

 private:
  void add_body(std::size_t index, const std::string& indent) {
    const SceneLink& link = links_[index];
    const Eigen::Quaterniond turn(Eigen::Matrix3d(link.place.block<3, 3>(0, 0)));
    bodies_ += indent + "<body name=\"" + link.name + "\" pos=\"" +
               metres_text(link.place.block<3, 1>(0, 3)) + "\" quat=\"" + number_text(turn.w()) +
               " " + numbers_text(turn.vec()) + "\">\n";
    if (const auto joint = joint_of(model_, links_, index)) add_joint(link, *joint, indent + "  ");
    if (!link.solid.faces.empty()) add_mesh(link, indent + "  ");
    for (std::size_t i = index + 1; i < links_.size(); ++i)
      if (links_[i].parent == static_cast<int>(index)) add_body(i, indent + "  ");
    bodies_ += indent + "</body>\n";
  }

  void add_joint(const SceneLink& link, const ExportedJoint& joint, const std::string& indent) {
    const std::string range = number_text(joint.low) + " " + number_text(joint.high);
    const std::string limits =
        joint.is_endless ? "limited=\"false\"" : "limited=\"true\" range=\"" + range + "\"";
    bodies_ += indent + "<joint name=\"" + joint.name + "\" type=\"" +
               (link.motion == LinkMotion::kSlides ? "slide" : "hinge") + "\" axis=\"" +
               numbers_text(link.axis) + "\" " + limits + "/>\n";
    add_inertia(link.solid, indent);
    positions_ += (positions_.empty() ? "" : " ") + number_text(joint.home);
    joint.mimics.empty() ? add_actuator(joint, range) : add_equality(joint);
  }

  void add_inertia(const Solid& solid, const std::string& indent) {
    const auto [center, mass, moments] = box_inertia(solid);
    bodies_ += indent + "<inertial pos=\"" + metres_text(center) + "\" mass=\"" +
               number_text(mass) + "\" diaginertia=\"" + numbers_text(moments) + "\"/>\n";
  }

  void add_mesh(const SceneLink& link, const std::string& indent) {
    assets_ += "    <mesh name=\"" + link.name + "\" file=\"" + mesh_path(link) + "\"/>\n";
    bodies_ += indent + "<geom type=\"mesh\" mesh=\"" + link.name + "\" rgba=\"" +
               color_text(link.color) + "\"/>\n";
  }

  void add_equality(const ExportedJoint& joint) {
    equalities_ += "    <joint joint1=\"" + joint.name + "\" joint2=\"" + joint.mimics +
                   "\" polycoef=\"0 1 0 0 0\" solref=\"0.005 1\"/>\n";
  }

  void add_actuator(const ExportedJoint& joint, const std::string& range) {
    const std::string limits =
        joint.is_endless ? "" : " ctrllimited=\"true\" ctrlrange=\"" + range + "\"";
    actuators_ +=
        "    <position name=\"" + joint.name + "\" joint=\"" + joint.name + "\"" + limits + "/>\n";
    controls_ += (controls_.empty() ? "" : " ") + number_text(joint.home);
  }

  const Model& model_;
  const std::vector<SceneLink>& links_;
  std::string assets_;
  std::string bodies_;
  std::string equalities_;
  std::string actuators_;
  std::string positions_;  ///< a value of the key frame for each joint
  std::string controls_;   ///< a value of the key frame for each actuator
};

}  // namespace

std::vector<ExportedFile> to_mjcf(const Model& model, const std::string& name) {
  const std::vector<SceneLink> links = scene_links(model);
  std::vector<ExportedFile> files{{name + ".xml", MjcfWriter(model, links).text(name)}};
  add_meshes(files, links);
  return files;
}

}  // namespace xr3
