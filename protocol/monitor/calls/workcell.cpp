// The calls on the workcell: `block_add`, `block_move`, `block_remove` and `workcell`.
#include "protocol/files/workcell.hpp"

#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

CallValue read_block_add(ArgsReader& args) {
  Block block;
  block.name = args.coded("name", data::block_name()).value_or("");
  block.size_um = args.coded("size_mm", data::block_size()).value_or(PointUm{});
  block.centroid_um = args.coded("xyz_mm", data::block_centroid()).value_or(PointUm{});
  block.yaw_udeg = args.coded("yaw_deg", data::yaw(), Presence::kOptional).value_or(0);
  block.color = args.coded("color", data::block_color()).value_or(0);
  return call::AddBlock{std::move(block)};
}

Json write_block_add(const call::AddBlock& add) {
  const Block& block = add.block;
  return {{"name", block.name},
          {"size_mm", data::block_size().write(block.size_um)},
          {"xyz_mm", data::block_centroid().write(block.centroid_um)},
          {"yaw_deg", data::yaw().write(block.yaw_udeg)},
          {"color", block.color}};
}

CallValue read_block_move(ArgsReader& args) {
  call::MoveBlock move;
  move.name = args.coded("name", data::block_name()).value_or("");
  move.centroid_um = args.coded("xyz_mm", data::block_centroid(), Presence::kOptional);
  move.yaw_udeg = args.coded("yaw_deg", data::yaw(), Presence::kOptional);
  if (!args.ask("xyz_mm") && !args.ask("yaw_deg"))
    args.refuse("xyz_mm", "a place, or else a yaw_deg");
  return move;
}

Json write_block_move(const call::MoveBlock& move) {
  Json args = {{"name", move.name}};
  if (move.centroid_um) args["xyz_mm"] = data::block_centroid().write(*move.centroid_um);
  if (move.yaw_udeg) args["yaw_deg"] = data::yaw().write(*move.yaw_udeg);
  return args;
}

CallValue read_block_remove(ArgsReader& args) {
  return call::RemoveBlock{args.coded("name", data::block_name()).value_or("")};
}

Json write_block_remove(const call::RemoveBlock& remove) { return {{"name", remove.name}}; }

CallValue read_workcell_call(ArgsReader& args) {
  const JsonValue value =
      document(args, "workcell", Presence::kRequired, "an object in the form of a workcell file");
  if (!value) return call::ReplaceWorkcell{};
  data::Reading reading(value, data::Unit::kOfDocument);
  std::optional<Workcell> workcell = read_workcell(reading, nullptr, 0, args.bounds());
  args.findings().add_errors(reading, "");
  return call::ReplaceWorkcell{std::move(workcell).value_or(Workcell{})};
}

Json write_workcell_call(const call::ReplaceWorkcell& replace) {
  return {{"workcell", workcell_to_json(replace.workcell)}};
}

constexpr CallForm kWorkcellCalls[] = {
    {"block_add", "Adds a block to the workcell.", read_block_add,
     write_as<call::AddBlock, write_block_add>},
    {"block_move", "Moves a block.", read_block_move, write_as<call::MoveBlock, write_block_move>},
    {"block_remove", "Removes a block.", read_block_remove,
     write_as<call::RemoveBlock, write_block_remove>},
    {"workcell", "Replaces the workcell.", read_workcell_call,
     write_as<call::ReplaceWorkcell, write_workcell_call>},
};

}  // namespace

CallForms workcell_calls() { return kWorkcellCalls; }

}  // namespace xr3::monitor
