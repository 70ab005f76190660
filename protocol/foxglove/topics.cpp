#include "protocol/foxglove/topics.hpp"

#include <nlohmann/json.hpp>

#include "protocol/json/document.hpp"

namespace xr3::foxglove {
namespace {

Json of(std::string_view type) { return Json::object({{"type", type}}); }
Json number() { return of("number"); }
Json integer() { return of("integer"); }
Json boolean() { return of("boolean"); }
Json text() { return of("string"); }

Json object(Json::object_t properties) {
  Json schema = of("object");
  schema["properties"] = std::move(properties);
  return schema;
}

Json titled(std::string_view title, Json schema) {
  schema["title"] = title;
  return schema;
}

Json list(Json items) {
  Json schema = of("array");
  schema["items"] = std::move(items);
  return schema;
}

Json base64() {
  Json schema = text();
  schema["contentEncoding"] = "base64";
  return schema;
}

// Apps recognise times and durations by their titles.
Json seconds(std::string_view title) {
  return titled(title, object({{"sec", integer()}, {"nsec", integer()}}));
}
Json time() { return seconds("time"); }

Json xyz() { return object({{"x", number()}, {"y", number()}, {"z", number()}}); }
Json quaternion() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() { return object({{"position", xyz()}, {"orientation", quaternion()}}); }
Json color() {
  return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json transforms() {
  return object({{"transforms", list(object({{"timestamp", time()},
                                             {"parent_frame_id", text()},
                                             {"child_frame_id", text()},
                                             {"translation", xyz()},
                                             {"rotation", quaternion()}}))}});
}

Json lines() {
  return object({{"type", integer()},
                 {"pose", pose()},
                 {"thickness", number()},
                 {"scale_invariant", boolean()},
                 {"points", list(xyz())},
                 {"color", color()},
                 {"colors", list(color())},
                 {"indices", list(integer())}});
}

Json triangles() {
  return object({{"pose", pose()},
                 {"points", list(xyz())},
                 {"color", color()},
                 {"colors", list(color())},
                 {"indices", list(integer())}});
}

Json cylinders() {
  return object({{"pose", pose()},
                 {"size", xyz()},
                 {"bottom_scale", number()},
                 {"top_scale", number()},
                 {"color", color()}});
}

Json entity() {
  return object({{"timestamp", time()},
                 {"frame_id", text()},
                 {"id", text()},
                 {"lifetime", seconds("duration")},
                 {"frame_locked", boolean()},
                 {"cubes", list(object({{"pose", pose()}, {"size", xyz()}, {"color", color()}}))},
                 {"cylinders", list(cylinders())},
                 {"lines", list(lines())},
                 {"triangles", list(triangles())}});
}

Json scene() {
  const Json deletion = object({{"timestamp", time()}, {"type", integer()}, {"id", text()}});
  return object({{"deletions", list(deletion)}, {"entities", list(entity())}});
}

Json image() {
  return object(
      {{"timestamp", time()}, {"frame_id", text()}, {"data", base64()}, {"format", text()}});
}

Json log() {
  return object({{"timestamp", time()},
                 {"level", integer()},
                 {"message", text()},
                 {"name", text()},
                 {"file", text()},
                 {"line", integer()}});
}

Json state(const Model& model) {
  const Json joint = object(
      {{"value", number()}, {"count", integer()}, {"error", integer()}, {"moving", boolean()}});
  Json::object_t joints;
  for (const char label : model.labels()) joints[std::string(1, label)] = joint;
  return object({{"tick", integer()},
                 {"epoch", integer()},
                 {"moving", boolean()},
                 {"stalled", text()},
                 {"enabled", boolean()},
                 {"joints", object(std::move(joints))},
                 {"tip", object({{"x_mm", number()}, {"y_mm", number()}, {"z_mm", number()}})},
                 {"opening_mm", number()},
                 {"holding", text()},
                 {"inputs", integer()},
                 {"outputs", integer()}});
}

Json schema_of(Topic topic, const Model& model) {
  switch (topic) {
    case Topic::kTransforms: return transforms();
    case Topic::kScene:
    case Topic::kBlocks: return scene();
    case Topic::kCamera: return image();
    case Topic::kEvents: return log();
    case Topic::kState: return state(model);
  }
  return {};
}

}  // namespace

const std::array<TopicInfo, kTopics>& topics() {
  static constexpr std::array<TopicInfo, kTopics> kTable{{
      {Topic::kTransforms, "/tf", "foxglove.FrameTransforms"},
      {Topic::kScene, "/scene", "foxglove.SceneUpdate"},
      {Topic::kBlocks, "/blocks", "foxglove.SceneUpdate"},
      {Topic::kCamera, "/camera", "foxglove.CompressedImage"},
      {Topic::kEvents, "/events", "foxglove.Log"},
      {Topic::kState, "/state", "xr3.State"},
  }};
  return kTable;
}

std::string schema_text(Topic topic, const Model& model) {
  const std::string_view name = topics().at(static_cast<std::size_t>(topic)).schema;
  return titled(name, schema_of(topic, model)).dump();
}

}  // namespace xr3::foxglove
