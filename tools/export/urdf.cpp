#include "tools/export/exported.hpp"
#include "tools/export/inertia.hpp"
#include "tools/export/joint.hpp"
#include "tools/export/numbers.hpp"
#include "tools/export/stl.hpp"
#include "tools/kin/report.hpp"
#include "tools/text/markup.hpp"

namespace xr3 {
namespace {

/// Without these, MuJoCo would drop visuals and join the frame of the tool to the last link.
constexpr const char* kHead = R"(  <!-- Made by xr3 export, in metres and radians.
       Masses, inertias and efforts are guesses. -->
  <mujoco>
    <compiler strippath="false" discardvisual="false" fusestatic="false" balanceinertia="true"/>
  </mujoco>
)";
constexpr double kEffort = 100;  ///< N m or N: robot files have none

/// The element `origin` of a place in mm.
std::string origin(const Transform& place) {
  const Eigen::Vector3d angles = yaw_pitch_roll_deg(place.block<3, 3>(0, 0)) * (kPi / 180);
  return "<origin xyz=\"" + metres_text(place.block<3, 1>(0, 3)) + "\" rpy=\"" +
         numbers_text(angles.reverse()) + "\"/>";
}

std::string inertial(const Solid& solid) {
  const auto [center, mass, moments] = box_inertia(solid);
  return "    <inertial>\n      <origin xyz=\"" + metres_text(center) +
         "\"/>\n      <mass value=\"" + number_text(mass) + "\"/>\n      <inertia ixx=\"" +
         number_text(moments.x()) + "\" ixy=\"0\" ixz=\"0\" iyy=\"" + number_text(moments.y()) +
         "\" iyz=\"0\" izz=\"" + number_text(moments.z()) + "\"/>\n    </inertial>\n";
}

std::string visual(const SceneLink& link) {
  return "    <visual>\n      <geometry><mesh filename=\"" + mesh_path(link) +
         "\"/></geometry>\n      <material name=\"color_" + std::to_string(link.color) +
         "\"><color rgba=\"" + color_text(link.color) + "\"/></material>\n    </visual>\n";
}

std::string link_element(const SceneLink& link) {
  std::string parts;
  if (!link.is_fixed()) parts += inertial(link.solid);
  if (!link.solid.faces.empty()) parts += visual(link);
  const std::string start = "  <link name=\"" + link.name + "\"";
  return parts.empty() ? start + "/>\n" : start + ">\n" + parts + "  </link>\n";
}

std::string joint_type(const SceneLink& link, const std::optional<ExportedJoint>& joint) {
  if (!joint) return "fixed";
  if (link.motion == LinkMotion::kSlides) return "prismatic";
  return joint->is_endless ? "continuous" : "revolute";
}

std::string motion(const SceneLink& link, const ExportedJoint& joint) {
  const std::string range = joint.is_endless ? ""
                                             : "lower=\"" + number_text(joint.low) + "\" upper=\"" +
                                                   number_text(joint.high) + "\" ";
  const std::string mimic =
      joint.mimics.empty() ? "" : "    <mimic joint=\"" + joint.mimics + "\"/>\n";
  return "    <axis xyz=\"" + numbers_text(link.axis) + "\"/>\n    <limit " + range + "effort=\"" +
         number_text(kEffort) + "\" velocity=\"" + number_text(joint.speed) + "\"/>\n" + mimic;
}

std::string joint_element(const SceneLink& link, const std::string& parent,
                          const std::optional<ExportedJoint>& joint) {
  return "  <joint name=\"" + (joint ? joint->name : link.name + "_fixed") + "\" type=\"" +
         joint_type(link, joint) + "\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + link.name + "\"/>\n    " + origin(link.place) + "\n" +
         (joint ? motion(link, *joint) : "") + "  </joint>\n";
}

}  // namespace

std::vector<ExportedFile> to_urdf(const Model& model, const std::string& name) {
  const std::vector<SceneLink> links = scene_links(model);
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + xml(name) + "\">\n" + kHead;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const SceneLink& link = links[i];
    text += link_element(link);
    if (link.parent >= 0)
      text += joint_element(link, links[static_cast<std::size_t>(link.parent)].name,
                            joint_of(model, links, i));
  }
  std::vector<ExportedFile> files{{name + ".urdf", text + "</robot>\n"}};
  add_meshes(files, links);
  return files;
}

}  // namespace xr3
