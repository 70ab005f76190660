#include "protocol/files/faults.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/fault_text.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr std::int64_t kMaxWhole = Fault::kMaxTicks;

Codec<std::string> fault_name() {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const auto parse = [=](JsonValue value) -> std::optional<std::string> {
    if (!value.is_text() || value.text_size() > Fault::kMaxName) return std::nullopt;
    const std::string name = value.text();
    if (name.empty() || name.find_first_not_of(kLetters) != name.npos) return std::nullopt;
    return name;
  };
  return parsed<std::string>("1 to 32 letters, digits, _ or -", parse);
}

Codec<FaultKind> fault_kind() {
  std::vector<std::pair<std::string, FaultKind>> names;
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    const auto kind = static_cast<FaultKind>(i);
    names.emplace_back(code_of(kind), kind);
  }
  return choice(std::move(names));
}

/// A number of a line, or "any", which is 0.
Codec<std::uint32_t> line_number() {
  const auto parse = [](JsonValue value) -> std::optional<std::uint32_t> {
    if (value.is("any")) return 0;
    const auto number = detail::integer_in(value, 1, UINT32_MAX);
    return number ? std::optional(static_cast<std::uint32_t>(*number)) : std::nullopt;
  };
  return parsed<std::uint32_t>(
      detail::integer_text(1, UINT32_MAX) + ", or \"any\"", parse,
      [](const std::uint32_t& line) { return line == 0 ? Json("any") : Json(line); });
}

/// A probability, read once into whole parts of kCertain.
Codec<std::uint32_t> probability() {
  const auto parse = [](JsonValue value) -> std::optional<std::uint32_t> {
    const double parts = value.is_number() ? value.number() * kCertain : 0;
    if (!(parts >= 0.5 && parts <= kCertain)) return std::nullopt;
    return static_cast<std::uint32_t>(std::llround(parts));
  };
  return parsed<std::uint32_t>(
      "a number from 0.000000001 to 1", parse,
      [](const std::uint32_t& parts) { return number_json(double(parts) / kCertain); });
}

const Members<FaultPlan>& plan_members() {
  static const Members<FaultPlan> members = {
      optional("notes", &FaultPlan::notes, text(0, 4000)),
      optional("seed", &FaultPlan::seed, fault_seed()),
      required("faults", &FaultPlan::faults, list(object(fault_members()), 0, kMaxFaults))};
  return members;
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

const Members<Fault>& data::fault_members() {
  static const Members<Fault> members = {
      required("name", &Fault::name, fault_name()),
      required("kind", &Fault::kind, fault_kind()),
      optional("line", &Fault::line, line_number()),
      optional("direction", &Fault::direction,
               choice<LineSide>({{"in", LineSide::kIn}, {"out", LineSide::kOut}})),
      optional("joint", &Fault::joint, motor_label()),
      optional("bit", &Fault::bit, whole_number(0, 7)),
      optional("byte", &Fault::byte, integer<std::uint8_t>(0, UINT8_MAX)),
      optional("percent", &Fault::percent, integer<std::uint32_t>(1, 99)),
      optional("delay_ms", &Fault::delay_ms, integer<std::uint32_t>(1, Fault::kMaxDelayMs)),
      optional("period_ms", &Fault::period_ms, integer<std::uint32_t>(1, Fault::kMaxPeriodMs)),
      optional("bounce_ms", &Fault::bounce_ms, integer<std::uint32_t>(1, Fault::kMaxBounceMs)),
      optional("row", &Fault::row, whole_number(0, kMaxSavedPixels - 1)),
      optional("columns", &Fault::columns, whole_number(-kMaxSavedPixels, kMaxSavedPixels)),
      optional("rows", &Fault::rows, whole_number(-kMaxSavedPixels, kMaxSavedPixels)),
      optional("at_tick", &Fault::at_tick, integer<Tick>(0, kMaxWhole)),
      optional("from_tick", &Fault::from_tick, integer<Tick>(0, kMaxWhole)),
      optional("after_bytes", &Fault::after_bytes, integer<std::uint64_t>(0, kMaxWhole)),
      optional("probability", &Fault::chance, probability()),
      optional("ticks", &Fault::ticks, integer<Tick>(1, kMaxWhole)),
      optional("count", &Fault::count, integer<std::uint32_t>(1, 1'000'000'000))};
  return members;
}

Codec<char> data::motor_label() {
  std::vector<std::pair<std::string, char>> labels;
  for (char label = 'A'; label <= 'H'; ++label) labels.emplace_back(std::string(1, label), label);
  return choice(std::move(labels));
}

Codec<std::uint64_t> data::fault_seed() { return integer<std::uint64_t>(0, kMaxWhole); }

std::optional<Fault> read_fault(Reading& reading) {
  Fault fault;
  const Place root{reading, reading.root()};
  if (read_object(root, fault_members(), fault)) check_fault(fault, "", "", reading);
  return reading.has_errors() ? std::nullopt : std::optional(std::move(fault));
}

FileReading<FaultPlan> read_faults(std::string_view text, const std::string& file,
                                   std::string_view labels) {
  return read_file(text, file, DataKind::kFaults, Unit::kMm, [&](Reading& reading) {
    return read_root(reading, plan_members(),
                     [&](const FaultPlan& plan, Reading&) { check_faults(plan, labels, reading); });
  });
}

FaultPlan load_faults(std::string_view text, const std::string& file, std::string_view labels) {
  return value_of(read_faults(text, file, labels));
}

// Required members are written even with the value of a default fault.
Json fault_to_json(const Fault& fault) {
  Json json = write_object(fault, fault_members());
  if (fault.kind == FaultKind::kStrayByte) json["byte"] = fault.byte;
  if (fault.kind == FaultKind::kCameraDeadRow) json["row"] = fault.row;
  if (fault.kind == FaultKind::kCameraOffset) json["columns"] = fault.columns;
  return json;
}

Json faults_to_json(const FaultPlan& plan) {
  Json faults = Json::array();
  for (const Fault& fault : plan.faults) faults.push_back(fault_to_json(fault));
  Json json = {{"seed", plan.seed}, {"faults", std::move(faults)}};
  if (!plan.notes.empty()) json["notes"] = plan.notes;
  return json;
}

std::string faults_summary(const FaultPlan& plan) {
  std::string text =
      plural(plan.faults.size(), "fault") + ", seed " + std::to_string(plan.seed) + "\n";
  if (!plan.notes.empty()) text += plan.notes + "\n";
  for (const Fault& fault : plan.faults)
    text += "  " + fault.name + ": " + std::string(code_of(fault.kind)) + "\n";
  return text;
}

}  // namespace xr3
