#include "protocol/recording/call_json.hpp"

#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3::recording {
namespace {

constexpr std::size_t kMaxFnLength = 40;

/// The arguments of `key`, for each command that it has.
struct KeyWriter {
  CallJson operator()(const ToggleDisplay&) const { return key("display"); }
  CallJson operator()(const SetViewVector& view) const {
    return key("view", Json{view.x, view.y, view.z});
  }
  CallJson operator()(const SoftHome&) const { return key("home"); }
  CallJson operator()(const SelectStatus& status) const { return key("status", status.option); }
  CallJson operator()(const ToggleSimulator&) const { return key("enabled"); }
  CallJson operator()(const ToggleFunctionKeys&) const { return key("function_keys"); }
  CallJson operator()(const SetRefreshPeriod& period) const {
    return key("period", period.half_seconds);
  }
  CallJson operator()(const ToggleErasing&) const { return key("path"); }
  template <class Other>
  CallJson operator()(const Other&) const {
    return key("");  // no reader makes such a call
  }

 private:
  static CallJson key(const char* function, Json value = {}) {
    Json args = {{"function", function}};
    if (!value.is_null()) args["value"] = std::move(value);
    return {"key", std::move(args)};
  }
};

/// A function for each kind of call.
struct CallWriter {
  CallJson operator()(const call::Pause&) const { return without_args("pause"); }
  CallJson operator()(const call::Resume&) const { return without_args("resume"); }
  CallJson operator()(const call::SetRate& rate) const {
    return {"rate", {{"factor", static_cast<double>(rate.rate.millionths) / 1e6}}};
  }
  CallJson operator()(const call::Step& step) const { return {"step", {{"ticks", step.ticks}}}; }
  CallJson operator()(const call::RunUntil& run) const {
    Json args = run.tick ? Json{{"tick", *run.tick}} : Json{{"idle", true}};
    args["max_ticks"] = run.max_ticks;
    return {"run_until", std::move(args)};
  }
  CallJson operator()(const call::Reset&) const { return without_args("reset"); }
  CallJson operator()(const call::Home&) const { return without_args("home"); }
  CallJson operator()(const call::Key& key) const { return std::visit(KeyWriter{}, key.command); }
  CallJson operator()(const call::StopDevice&) const { return without_args("device_stop"); }
  CallJson operator()(const call::AlignMirror&) const { return without_args("mirror_align"); }
  CallJson operator()(const call::SetInput& set) const {
    return {"input", {{"input", set.input}, {"value", set.value}}};
  }
  CallJson operator()(const call::AddBlock& add) const {
    const Block& block = add.block;
    return {"block_add",
            {{"name", block.name},
             {"size_mm", data::block_size().write(block.size_um)},
             {"xyz_mm", data::block_centroid().write(block.centroid_um)},
             {"yaw_deg", data::yaw().write(block.yaw_udeg)},
             {"color", block.color}}};
  }
  CallJson operator()(const call::MoveBlock& move) const {
    Json args = {{"name", move.name}};
    if (move.centroid_um) args["xyz_mm"] = data::block_centroid().write(*move.centroid_um);
    if (move.yaw_udeg) args["yaw_deg"] = data::yaw().write(*move.yaw_udeg);
    return {"block_move", std::move(args)};
  }
  CallJson operator()(const call::RemoveBlock& remove) const {
    return {"block_remove", {{"name", remove.name}}};
  }
  CallJson operator()(const call::ReplaceWorkcell& replace) const {
    return {"workcell", {{"workcell", workcell_to_json(replace.workcell)}}};
  }
  CallJson operator()(const call::SaveSnapshot& save) const {
    if (save.name.empty()) return {"snapshot_save", {{"inline", true}}};
    return {"snapshot_save", {{"name", save.name}}};
  }
  CallJson operator()(const call::LoadSnapshot& load) const {
    if (load.saved) return {"snapshot_load", {{"snapshot", saved_cell_to_json(*load.saved)}}};
    return {"snapshot_load", {{"name", load.name}}};
  }
  CallJson operator()(const call::SetFault& set) const {
    Json args = {{"fault", fault_to_json(set.fault)}};
    if (set.seed) args["seed"] = *set.seed;
    return {"fault_set", std::move(args)};
  }
  CallJson operator()(const call::ClearFault& clear) const {
    if (clear.name.empty()) return without_args("fault_clear");
    return {"fault_clear", {{"name", clear.name}}};
  }

 private:
  static CallJson without_args(const char* fn) { return {fn, Json::object()}; }
};

const monitor::CallForm* call_form(const data::Place& fn) {
  const bool is_name = fn.value.is_text() && fn.value.text_size() <= kMaxFnLength;
  return is_name ? monitor::find_call(fn.value.text()) : nullptr;
}

}  // namespace

CallJson call_to_json(const call::Call& call) { return std::visit(CallWriter{}, call); }

std::optional<call::Call> read_call_json(const data::Place& fn, JsonValue args) {
  const auto refuse = [&fn] {
    fn.refuse("the name of a call that changes the cell");
    return std::nullopt;
  };
  const monitor::CallForm* form = call_form(fn);
  if (form == nullptr) return refuse();
  monitor::Findings findings;
  monitor::ArgsReader reader(args, args ? args.pointer_from(fn.reading.root()) : "", findings);
  monitor::CallValue value = form->read(reader);
  reader.refuse_others();
  for (const monitor::Detail& detail : findings.error({}).details) {
    fn.reading.refuse(detail.pointer, detail.found.is_null() ? "" : data::shown(detail.found),
                      detail.allowed);
  }
  if (!findings.empty()) return std::nullopt;
  auto* call = std::get_if<call::Call>(&value);
  if (call == nullptr) return refuse();
  return std::move(*call);
}

}  // namespace xr3::recording
