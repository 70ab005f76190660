// The topics on which a cell is shown in Foxglove and Lichtblick: their names, and the JSON schemas
// of their messages.
//
// The flow through the folder, which has no sockets and no files: topics.hpp is the table of
// topics. messages.hpp makes the messages of the machine, its camera and its events, and scene.hpp
// those of the picture, as JSON texts from a model and a state. The frames to which both refer are
// the links of protocol/scene, geometry.hpp writes poses and colours, and time.hpp converts ticks
// to nanoseconds. wire.hpp has what only a WebSocket needs: the frames around messages, and the
// requests of a client. server/foxglove sends them live; a converted recording has them in a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/model.hpp"

namespace xr3::foxglove {

enum class Topic : std::uint8_t { kTransforms, kScene, kBlocks, kCamera, kEvents, kState };
inline constexpr std::size_t kTopics = 6;

struct TopicInfo {
  Topic topic;
  std::string_view name;    ///< such as `/tf`
  std::string_view schema;  ///< name of the schema, such as `foxglove.FrameTransforms`
};

/// In the order of Topic.
const std::array<TopicInfo, kTopics>& topics();

/// The JSON schema of a topic's messages: the members that are sent. Those of `foxglove.` describe
/// a part of the schemas of that name at https://docs.foxglove.dev. That of `xr3.State` depends on
/// the robot, whose joints are its members. Of the kinds of schema that Lichtblick reads: each type
/// is one word.
std::string schema_text(Topic topic, const Model& model);

}  // namespace xr3::foxglove
