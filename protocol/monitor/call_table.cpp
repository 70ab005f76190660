#include "protocol/monitor/call_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/monitor/key_arguments.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3::monitor {
namespace {

using Time = CallForm::Time;

// Each read function reads the args of a call into its value. It requests every argument regardless
// of what it finds, so that reading an empty object yields the description of the call. If there
// are findings, the returned value is meaningless.

constexpr std::size_t kMaxSent = 4096;              // bytes of a `send`
constexpr std::size_t kMaxSnapshotNameLength = 64;  // bytes
constexpr std::size_t kMaxMembers = 64;

/// Whether an object has more members than any valid document. Comparing their names would take
/// long.
bool is_crowded(JsonValue value) {
  if (!value.is_structured()) return false;
  if (value.is_object() && value.size() > kMaxMembers) return true;
  return std::any_of(value.begin(), value.end(), is_crowded);
}

/// An object in the form of a file; empty if it is omitted or invalid. Records the error.
JsonValue document(ArgsReader& args, const std::string& name, Presence presence,
                   const std::string& allowed) {
  const JsonValue value = args.object(name, presence, allowed);
  if (!is_crowded(value)) return value;
  args.refuse(name, "objects of at most " + std::to_string(kMaxMembers) + " members");
  return {};
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::optional<std::string> from_hexadecimal(const std::string& digits) {
  if (digits.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const int high = digit(digits[i]);
    const int low = digit(digits[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<char>(high * 16 + low));
  }
  return bytes;
}

data::Codec<std::string> bytes_in_hexadecimal() {
  data::Codec<std::string> codec;
  codec.allowed = "two hexadecimal digits a byte, at most " + std::to_string(kMaxSent) + " bytes";
  codec.read = [allowed = codec.allowed](const data::Place& place, std::string& bytes) {
    if (!place.value.is_text()) return place.refuse(allowed);
    const std::string digits = place.value.text(2 * kMaxSent + 1);
    auto read = digits.size() <= 2 * kMaxSent ? from_hexadecimal(digits) : std::nullopt;
    if (!read) return place.refuse(allowed);
    return bytes = *std::move(read), true;
  };
  return codec;
}

data::Codec<bool> only_true() {
  data::Codec<bool> codec;
  codec.allowed = "true";
  codec.read = [](const data::Place& place, bool& result) {
    result = place.value.is_true();
    return result || place.refuse("true");
  };
  return codec;
}

data::Codec<std::string> snapshot_name() { return data::text(1, kMaxSnapshotNameLength); }

template <class Call>
CallValue read_nothing(ArgsReader&) {
  return Call{};
}

// --- Time.

CallValue read_rate(ArgsReader& args) {
  const double factor = args.number("factor", 0.001, 100'000).value_or(1);
  return call::SetRate{{std::llround(factor * 1e6)}};
}

CallValue read_step(ArgsReader& args) {
  return call::Step{args.integer("ticks", 0, kMaxInteger).value_or(0)};
}

CallValue read_run_until(ArgsReader& args) {
  call::RunUntil run;
  const JsonValue idle = args.ask("idle", Presence::kOptional, "true, or else a tick");
  run.tick = args.integer("tick", 0, kMaxInteger, Presence::kOptional);
  const bool has_tick = static_cast<bool>(args.ask("tick"));
  if (idle && (has_tick || !idle.is_true())) args.refuse("idle", "true, and then no tick");
  if (!idle && !has_tick) args.refuse("idle", "true, or else a tick");
  run.max_ticks = args.integer("max_ticks", 0, kMaxInteger).value_or(0);
  return run;
}

/// The barrier in `after`, which may be omitted.
std::optional<After> read_after(ArgsReader& args) {
  const JsonValue object = args.object("after", Presence::kOptional,
                                       "an object of line, bytes_in and, where it is not 1000, "
                                       "within_ms");
  if (!object) return std::nullopt;
  ArgsReader members(object, args.pointer_to("after"), args.findings());
  After after;
  after.line = static_cast<std::uint32_t>(members.integer("line", 1, UINT32_MAX).value_or(1));
  after.bytes_in =
      static_cast<std::uint64_t>(members.integer("bytes_in", 0, kMaxInteger).value_or(0));
  after.within_ms = static_cast<int>(
      members.integer("within_ms", 0, kMaxWithinMs, Presence::kOptional).value_or(after.within_ms));
  members.refuse_others();
  return after;
}

// --- Lines and inputs.

CallValue read_send(ArgsReader& args) {
  auto text = args.coded("text", data::text(0, kMaxSent), Presence::kOptional);
  auto bytes = args.coded("hex", bytes_in_hexadecimal(), Presence::kOptional);
  args.has_one_of("text", "hex");
  return Send{text ? *std::move(text) : std::move(bytes).value_or("")};
}

CallValue read_input(ArgsReader& args) {
  const auto input = args.integer("input", 1, 8).value_or(1);
  return call::SetInput{static_cast<int>(input),
                        args.coded("value", data::boolean()).value_or(false)};
}

CallValue read_line_disconnect(ArgsReader& args) {
  return DisconnectLine{
      static_cast<std::uint32_t>(args.integer("line", 1, UINT32_MAX).value_or(1))};
}

// --- The workcell.

CallValue read_block_add(ArgsReader& args) {
  Block block;
  block.name = args.coded("name", data::block_name()).value_or("");
  block.size_um = args.coded("size_mm", data::block_size()).value_or(PointUm{});
  block.centroid_um = args.coded("xyz_mm", data::block_centroid()).value_or(PointUm{});
  block.yaw_udeg = args.coded("yaw_deg", data::yaw(), Presence::kOptional).value_or(0);
  block.color = args.coded("color", data::block_color()).value_or(0);
  return call::AddBlock{std::move(block)};
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

CallValue read_block_remove(ArgsReader& args) {
  return call::RemoveBlock{args.coded("name", data::block_name()).value_or("")};
}

CallValue read_workcell_call(ArgsReader& args) {
  const JsonValue value =
      document(args, "workcell", Presence::kRequired, "an object in the form of a workcell file");
  if (!value) return call::ReplaceWorkcell{};
  data::Reading reading(value, data::Unit::kOfDocument);
  std::optional<Workcell> workcell = read_workcell(reading);
  args.findings().add_errors(reading, "");
  return call::ReplaceWorkcell{std::move(workcell).value_or(Workcell{})};
}

// --- Snapshots.

CallValue read_snapshot_save(ArgsReader& args) {
  auto name = args.coded("name", snapshot_name(), Presence::kOptional);
  args.coded("inline", only_true(), Presence::kOptional);
  args.has_one_of("name", "inline");
  return call::SaveSnapshot{std::move(name).value_or("")};
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

// --- Faults.

CallValue read_fault_set(ArgsReader& args) {
  call::SetFault set;
  const JsonValue value = document(args, "fault", Presence::kRequired,
                                   "an object in the form of a fault file's faults");
  set.seed = args.coded("seed", data::fault_seed(), Presence::kOptional);
  if (!value) return set;
  data::Reading reading(value, data::Unit::kMm);
  set.fault = read_fault(reading).value_or(Fault{});
  args.findings().add_errors(reading, "");
  return set;
}

CallValue read_fault_clear(ArgsReader& args) {
  auto name = args.coded("name", data::text(1, Fault::kMaxName), Presence::kOptional);
  return call::ClearFault{std::move(name).value_or("")};
}

// --- The past.

PastTime read_past_time(ArgsReader& args) {
  PastTime at;
  at.tick = args.integer("tick", 0, kMaxInteger).value_or(0);
  at.epoch = args.integer("epoch", 0, kMaxInteger, Presence::kOptional);
  return at;
}

data::Codec<std::vector<Channel>> latest_wins_channels() {
  std::vector<std::pair<std::string, Channel>> names;
  for (const Channel channel :
       {Channel::kState, Channel::kImage, Channel::kDisplay, Channel::kModel})
    names.emplace_back(name_of(channel), channel);
  const std::size_t most = names.size();
  return data::list(data::choice(std::move(names)), 0, most);
}

CallValue read_look(ArgsReader& args) {
  Look look{read_past_time(args), {}};
  const auto channels = args.coded("channels", latest_wins_channels(), Presence::kOptional)
                            .value_or(std::vector<Channel>{Channel::kState});
  const auto encodings =
      data::choice<Encoding>({{"rows", Encoding::kRows}, {"rle", Encoding::kRle}});
  const Encoding encoding =
      args.coded("encoding", encodings, Presence::kOptional).value_or(Encoding::kRows);
  for (const Channel channel : channels) {
    const bool is_image = channel == Channel::kImage;
    look.selections.push_back({channel, {}, is_image ? encoding : Encoding::kRows});
  }
  return look;
}

CallValue read_seek(ArgsReader& args) { return Seek{read_past_time(args)}; }

CallValue read_branch(ArgsReader& args) { return Branch{read_past_time(args)}; }

// --- Description.

CallValue read_describe(ArgsReader& args) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& fn : calls()) names.emplace_back(fn, fn);
  return Describe{args.coded("fn", data::choice(std::move(names)), Presence::kOptional)};
}

// --- The table.

constexpr std::array kForms = {
    CallForm{"pause", "Stops simulated time; the clock is then manual.", read_nothing<call::Pause>},
    CallForm{"resume", "Makes simulated time follow the wall clock, or the byte clock, again.",
             read_nothing<call::Resume>},
    CallForm{"rate", "Sets the number of simulated seconds per second.", read_rate},
    CallForm{"step", "Advances simulated time by a number of ticks; not with a real clock.",
             read_step, Time::kMoves},
    CallForm{"run_until",
             "Advances simulated time until nothing moves or to a tick; not with a real clock.",
             read_run_until, Time::kMoves},
    CallForm{"reset", "Begins a new epoch with the initial state of the files.",
             read_nothing<call::Reset>},
    CallForm{"home", "Moves the robot to its soft home, as A$ does.", read_nothing<call::Home>},
    CallForm{"device_stop", "Stops all joints of the physical controller.",
             read_nothing<call::StopDevice>},
    CallForm{"mirror_align",
             "Moves the simulation to its soft home, where the physical arm has been put.",
             read_nothing<call::AlignMirror>},
    CallForm{"send", "Sends bytes on a serial line that belongs to this client.", read_send},
    CallForm{"input", "Sets an input line high or low.", read_input},
    CallForm{"block_add", "Adds a block to the workcell.", read_block_add},
    CallForm{"block_move", "Moves a block.", read_block_move},
    CallForm{"block_remove", "Removes a block.", read_block_remove},
    CallForm{"workcell", "Replaces the workcell.", read_workcell_call},
    CallForm{"snapshot_save", "Saves state and workcell under a name, or returns them.",
             read_snapshot_save},
    CallForm{"snapshot_load", "Begins a new epoch with a saved state and workcell.",
             read_snapshot_load},
    CallForm{"fault_set", "Adds a fault, or replaces the one with its name.", read_fault_set},
    CallForm{"fault_list", "Lists the faults and their effects so far.", read_nothing<ListFaults>},
    CallForm{"fault_clear", "Removes a fault, or all.", read_fault_clear},
    CallForm{"lines", "Lists the open serial lines, and the physical controller.",
             read_nothing<ListLines>},
    CallForm{"cells", "Lists the cells of the server.", read_nothing<ListCells>},
    CallForm{"line_disconnect", "Closes a serial line.", read_line_disconnect},
    CallForm{"transcript",
             "Gives a digest of all bytes of the lines in this epoch, and of the state.",
             read_nothing<ReadTranscript>},
    CallForm{"history", "Gives the times that can be seen again, and their events.",
             read_nothing<ReadHistory>},
    CallForm{"look", "Shows a time of the past to this client only.", read_look},
    CallForm{"live", "Ends look: this client sees the present again.", read_nothing<Live>},
    CallForm{"seek", "Takes the cell back to a time of its past, where it waits for resume.",
             read_seek},
    CallForm{"branch", "Opens a new cell that goes on from a time of this one's past.",
             read_branch},
    CallForm{"key", "Runs a function of the controller's command mode.", read_key},
    CallForm{"describe", "Lists the calls and their arguments.", read_describe},
};

/// Reads all members of args.
CallRequest read_args(const CallForm& form, ArgsReader& args) {
  CallRequest request{std::string(form.fn), form.read(args), {}, {}};
  if (form.time == Time::kMoves) {
    request.after = read_after(args);
    request.fields = args.fields("fields", Channel::kState);
  }
  return request;
}

/// The arguments that the call's reader requests from an empty object.
Json form_json(const CallForm& form) {
  Findings ignored;
  ArgsReader nothing({}, "", ignored);
  read_args(form, nothing);
  Json args = Json::array();
  for (const Asked& each : nothing.asked()) {
    args.push_back(
        {{"name", each.name}, {"required", each.is_required}, {"allowed", each.allowed}});
  }
  return {{"fn", form.fn}, {"purpose", form.purpose}, {"args", std::move(args)}};
}

}  // namespace

const CallForm* find_call(std::string_view fn) {
  const auto* form = std::find_if(kForms.begin(), kForms.end(),
                                  [&fn](const CallForm& each) { return each.fn == fn; });
  return form == kForms.end() ? nullptr : form;
}

CallRequest read_call(const CallForm& form, ArgsReader& members) {
  const JsonValue object = members.object("args", Presence::kOptional);
  ArgsReader args(object, members.pointer_to("args"), members.findings());
  CallRequest request = read_args(form, args);
  args.refuse_others();
  return request;
}

Json description(const std::optional<std::string>& fn) {
  Json calls = Json::array();
  for (const CallForm& form : kForms) {
    if (!fn || form.fn == *fn) calls.push_back(form_json(form));
  }
  return {{"calls", std::move(calls)}};
}

const std::vector<std::string>& calls() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const CallForm& form : kForms) all.emplace_back(form.fn);
    return all;
  }();
  return names;
}

}  // namespace xr3::monitor
