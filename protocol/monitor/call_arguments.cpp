#include "protocol/monitor/call_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3::monitor {
namespace {

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

}  // namespace

// --- Time.

CallValue read_rate(ArgsReader& args) {
  const double factor = args.number("factor", 0.001, 100'000).value_or(1);
  return call::SetRate{{std::llround(factor * 1e6)}};
}

CallValue read_step(ArgsReader& args) {
  return call::Step{args.whole("ticks", 0, kMaxInteger).value_or(0)};
}

CallValue read_run_until(ArgsReader& args) {
  call::RunUntil run;
  const JsonValue idle = args.ask("idle", Presence::kOptional, "true, or else a tick");
  run.tick = args.whole("tick", 0, kMaxInteger, Presence::kOptional);
  const bool has_tick = static_cast<bool>(args.ask("tick"));
  if (idle && (has_tick || !idle.is_true())) args.refuse("idle", "true, and then no tick");
  if (!idle && !has_tick) args.refuse("idle", "true, or else a tick");
  run.max_ticks = args.whole("max_ticks", 0, kMaxInteger).value_or(0);
  return run;
}

std::optional<After> read_after(ArgsReader& args) {
  const JsonValue object = args.object("after", Presence::kOptional,
                                       "an object of line, bytes_in and, where it is not 1000, "
                                       "within_ms");
  if (!object) return std::nullopt;
  ArgsReader members(object, args.pointer_to("after"), args.findings());
  After after;
  after.line = static_cast<std::uint32_t>(members.whole("line", 1, UINT32_MAX).value_or(1));
  after.bytes_in =
      static_cast<std::uint64_t>(members.whole("bytes_in", 0, kMaxInteger).value_or(0));
  after.within_ms = static_cast<int>(
      members.whole("within_ms", 0, kMaxWithinMs, Presence::kOptional).value_or(after.within_ms));
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
  const auto input = args.whole("input", 1, 8).value_or(1);
  return call::SetInput{static_cast<int>(input),
                        args.coded("value", data::boolean()).value_or(false)};
}

CallValue read_line_disconnect(ArgsReader& args) {
  return DisconnectLine{static_cast<std::uint32_t>(args.whole("line", 1, UINT32_MAX).value_or(1))};
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

// --- Description.

CallValue read_describe(ArgsReader& args) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& fn : calls()) names.emplace_back(fn, fn);
  const auto fn = args.coded("fn", data::choice(std::move(names)), Presence::kOptional);
  return Describe{fn ? Json(*fn) : Json()};
}

}  // namespace xr3::monitor
