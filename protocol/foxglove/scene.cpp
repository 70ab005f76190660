#include "protocol/foxglove/scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/grasp.hpp"
#include "protocol/foxglove/geometry.hpp"
#include "protocol/monitor/message.hpp"

namespace xr3::foxglove {
namespace {

constexpr int kDeleteAll = 1;  ///< foxglove.SceneEntityDeletionType
constexpr int kLineList = 2;   ///< foxglove.LineType
constexpr double kLinePixels = 1;

Json black() { return Json::object({{"r", 0.0}, {"g", 0.0}, {"b", 0.0}, {"a", 1.0}}); }

Json origin() { return pose_json(Transform::Identity()); }

Json corners_json(const std::vector<Triangle>& faces) {
  Json points = Json::array();
  for (const Triangle& face : faces)
    for (const Eigen::Vector3d& corner : face) points.push_back(metres_json(corner));
  return points;
}

/// Both ends of each line.
Json ends_json(const std::vector<Stroke>& strokes) {
  Json points = Json::array();
  for (const Stroke& stroke : strokes) {
    for (std::size_t i = 1; i < stroke.size(); ++i) {
      points.push_back(metres_json(stroke[i - 1]));
      points.push_back(metres_json(stroke[i]));
    }
  }
  return points;
}

Json faces_json(const Solid& solid, int color) {
  if (solid.faces.empty()) return Json::array();
  Json list = Json::object({{"pose", origin()},
                            {"points", corners_json(solid.faces)},
                            {"color", color_json(color)},
                            {"colors", Json::array()},
                            {"indices", Json::array()}});
  return Json::array({std::move(list)});
}

/// Black edges of faces; lines without faces have the colour of the link.
Json edges_json(const Solid& solid, int color) {
  if (solid.strokes.empty()) return Json::array();
  Json list = Json::object({{"type", kLineList},
                            {"pose", origin()},
                            {"thickness", kLinePixels},
                            {"scale_invariant", true},
                            {"points", ends_json(solid.strokes)},
                            {"color", solid.faces.empty() ? color_json(color) : black()},
                            {"colors", Json::array()},
                            {"indices", Json::array()}});
  return Json::array({std::move(list)});
}

/// An entity without primitives. Apps read all members, so that empty lists are sent, too.
Json entity_json(std::string_view id, std::string_view frame, const Json& time) {
  Json entity = Json::object({{"timestamp", time},
                              {"frame_id", frame},
                              {"id", id},
                              {"lifetime", time_json(0)},
                              {"frame_locked", true}});
  for (const char* list : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                           "triangles", "texts", "models"})
    entity[list] = Json::array();
  return entity;
}

Json link_json(const SceneLink& link, const Json& time) {
  Json entity = entity_json(link.name, link.name, time);
  entity["triangles"] = faces_json(link.solid, link.color);
  entity["lines"] = edges_json(link.solid, link.color);
  return entity;
}

Json block_json(const PlacedBlock& placed, const Json& time) {
  const PointUm& size = placed.block.size_um;
  Json entity = entity_json(placed.block.name, placed.frame, time);
  Json cube = Json::object({{"pose", pose_json(placed.pose)},
                            {"size", metres_json({mm(size.x), mm(size.y), mm(size.z)})},
                            {"color", color_json(placed.block.color)}});
  entity["cubes"] = Json::array({std::move(cube)});
  return entity;
}

/// A message that replaces all entities of its topic.
std::string update_text(Json entities, const Json& time) {
  Json all = Json::object({{"timestamp", time}, {"type", kDeleteAll}, {"id", ""}});
  return monitor::text_of(Json::object(
      {{"deletions", Json::array({std::move(all)})}, {"entities", std::move(entities)}}));
}

// --- The frames of blocks.

/// Turned with the tool since it was grasped, with its centre at the tip; see block_pose().
PlacedBlock held_block(const Model& model, const Block& block, const Held& held) {
  Transform pose = Transform::Identity();
  const Transform grasped = tool_transform(model, held.grasped_at);
  pose.block<3, 3>(0, 0) =
      grasped.block<3, 3>(0, 0).transpose() * lying_pose(block).block<3, 3>(0, 0);
  return {block, "tool", pose};
}

/// At the place on the carousel where it was put, seen from the frame that turns.
PlacedBlock riding_block(const Model& model, Block block, const Rider& rider) {
  const Carousel& carousel = *model.robot().carousel;
  block.centroid_um = rider.centroid_um;
  block.yaw_udeg = rider.yaw_udeg;
  Transform pose = lying_pose(block);
  pose.block<2, 1>(0, 3) -= Eigen::Vector2d(carousel.x_mm, carousel.y_mm);
  const auto [sin, cos] = sin_cos_deg(model.variable(model.carousel_index(), rider.count));
  Transform back = Transform::Identity();
  back.block<2, 2>(0, 0) << cos, sin, -sin, cos;
  return {std::move(block), "carousel", back * pose};
}

PlacedBlock placed_block(const Model& model, const State& state, std::size_t index) {
  const Block& block = state.blocks[index];
  if (is_held(state, index)) return held_block(model, block, *state.held);
  const auto rider = std::find_if(state.riders.begin(), state.riders.end(),
                                  [&](const Rider& each) { return each.block == index; });
  if (rider != state.riders.end()) return riding_block(model, block, *rider);
  return {block, "base", lying_pose(block)};
}

}  // namespace

std::string scene_text(const std::vector<SceneLink>& links, Nanoseconds time) {
  const Json stamp = time_json(time);
  Json entities = Json::array();
  for (const SceneLink& link : links)
    if (!link.solid.strokes.empty()) entities.push_back(link_json(link, stamp));
  return update_text(std::move(entities), stamp);
}

std::vector<PlacedBlock> placed_blocks(const Model& model, const State& state) {
  std::vector<PlacedBlock> placed;
  placed.reserve(state.blocks.size());
  for (std::size_t i = 0; i < state.blocks.size(); ++i)
    placed.push_back(placed_block(model, state, i));
  return placed;
}

std::string blocks_text(const std::vector<PlacedBlock>& blocks, Nanoseconds time) {
  const Json stamp = time_json(time);
  Json entities = Json::array();
  for (const PlacedBlock& block : blocks) entities.push_back(block_json(block, stamp));
  return update_text(std::move(entities), stamp);
}

}  // namespace xr3::foxglove
