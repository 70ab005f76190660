// The calls on snapshots: `snapshot_save` and `snapshot_load`.
#include <memory>
#include <utility>

#include "protocol/monitor/calls/form.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxSnapshotNameLength = 64;  // bytes

data::Codec<bool> only_true() {
  return data::parsed<bool>(
      "true", [](JsonValue value) { return value.is_true() ? std::optional(true) : std::nullopt; });
}

data::Codec<std::string> snapshot_name() { return data::text(1, kMaxSnapshotNameLength); }

CallValue read_snapshot_save(ArgsReader& args) {
  auto name = args.coded("name", snapshot_name(), Presence::kOptional);
  args.coded("inline", only_true(), Presence::kOptional);
  args.has_one_of("name", "inline");
  return call::SaveSnapshot{std::move(name).value_or("")};
}

Json write_snapshot_save(const call::SaveSnapshot& save) {
  return save.name.empty() ? Json{{"inline", true}} : Json{{"name", save.name}};
}

CallValue read_snapshot_load(ArgsReader& args) {
  auto name = args.coded("name", snapshot_name(), Presence::kOptional);
  const JsonValue value =
      document(args, "snapshot", Presence::kOptional, "what snapshot_save gave");
  if (!args.has_one_of("name", "snapshot") || !value) {
    return call::LoadSnapshot{std::move(name).value_or(""), nullptr};
  }
  data::Reading reading(value, data::Unit::kMm);
  std::optional<SavedCell> saved = read_saved_cell(reading);
  args.findings().add_errors(reading, "");
  if (!saved) return call::LoadSnapshot{};
  return call::LoadSnapshot{"", std::make_shared<const SavedCell>(*std::move(saved))};
}

Json write_snapshot_load(const call::LoadSnapshot& load) {
  if (load.saved) return {{"snapshot", saved_cell_to_json(*load.saved)}};
  return {{"name", load.name}};
}

constexpr CallForm kSnapshotCalls[] = {
    {"snapshot_save", "Saves state and workcell under a name, or returns them.", read_snapshot_save,
     write_as<call::SaveSnapshot, write_snapshot_save>},
    {"snapshot_load", "Begins a new epoch with a saved state and workcell.", read_snapshot_load,
     write_as<call::LoadSnapshot, write_snapshot_load>},
};

}  // namespace

CallForms snapshot_calls() { return kSnapshotCalls; }

}  // namespace xr3::monitor
