#include "protocol/files/faults.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/fault_text.hpp"
#include "protocol/files/fault_consistency.hpp"
#include "protocol/files/kind.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr int kMaxCameraPixels = 2048;
constexpr std::int64_t kMaxWhole = Fault::kMaxTicks;

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

Codec<std::string> fault_name() {
  Codec<std::string> codec;
  codec.allowed = "1 to 32 letters, digits, _ or -";
  codec.read = [allowed = codec.allowed](const Place& place, std::string& name) {
    if (!place.value.is_text() || place.value.text_size() > Fault::kMaxName)
      return place.refuse(allowed);
    name = place.value.text();
    const bool is_good = !name.empty() && std::all_of(name.begin(), name.end(), is_name_letter);
    return is_good || place.refuse(allowed);
  };
  codec.write = [](const std::string& name) { return Json(name); };
  return codec;
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
  const auto number = integer<std::uint32_t>(1, UINT32_MAX);
  Codec<std::uint32_t> codec;
  codec.allowed = number.allowed + ", or \"any\"";
  codec.read = [allowed = codec.allowed](const Place& place, std::uint32_t& line) {
    if (place.value.is("any")) return line = 0, true;
    const auto found = detail::integer_in(place.value, 1, UINT32_MAX);
    if (!found) return place.refuse(allowed);
    return line = static_cast<std::uint32_t>(*found), true;
  };
  codec.write = [](const std::uint32_t& line) { return line == 0 ? Json("any") : Json(line); };
  return codec;
}

Codec<char> joint_label() {
  std::vector<std::pair<std::string, char>> labels;
  for (char label = 'A'; label <= 'H'; ++label) labels.emplace_back(std::string(1, label), label);
  return choice(std::move(labels));
}

/// A probability, read once into whole parts of kCertain.
Codec<std::uint32_t> probability() {
  Codec<std::uint32_t> codec;
  codec.allowed = "a number from 0.000000001 to 1";
  codec.read = [allowed = codec.allowed](const Place& place, std::uint32_t& parts) {
    if (!place.value.is_number()) return place.refuse(allowed);
    const double number = place.value.number() * kCertain;
    if (!(number >= 0.5 && number <= kCertain)) return place.refuse(allowed);
    return parts = static_cast<std::uint32_t>(std::llround(number)), true;
  };
  codec.write = [](const std::uint32_t& parts) { return number_json(double(parts) / kCertain); };
  return codec;
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
      optional("joint", &Fault::joint, joint_label()),
      optional("bit", &Fault::bit, whole_number(0, 7)),
      optional("byte", &Fault::byte, integer<std::uint8_t>(0, UINT8_MAX)),
      optional("percent", &Fault::percent, integer<std::uint32_t>(1, 99)),
      optional("delay_ms", &Fault::delay_ms, integer<std::uint32_t>(1, Fault::kMaxDelayMs)),
      optional("period_ms", &Fault::period_ms, integer<std::uint32_t>(1, Fault::kMaxPeriodMs)),
      optional("bounce_ms", &Fault::bounce_ms, integer<std::uint32_t>(1, Fault::kMaxBounceMs)),
      optional("row", &Fault::row, whole_number(0, kMaxCameraPixels - 1)),
      optional("columns", &Fault::columns, whole_number(-kMaxCameraPixels, kMaxCameraPixels)),
      optional("rows", &Fault::rows, whole_number(-kMaxCameraPixels, kMaxCameraPixels)),
      optional("at_tick", &Fault::at_tick, integer<Tick>(0, kMaxWhole)),
      optional("from_tick", &Fault::from_tick, integer<Tick>(0, kMaxWhole)),
      optional("after_bytes", &Fault::after_bytes, integer<std::uint64_t>(0, kMaxWhole)),
      optional("probability", &Fault::chance, probability()),
      optional("ticks", &Fault::ticks, integer<Tick>(1, kMaxWhole)),
      optional("count", &Fault::count, integer<std::uint32_t>(1, 1'000'000'000))};
  return members;
}

Codec<std::uint64_t> data::fault_seed() { return integer<std::uint64_t>(0, kMaxWhole); }

std::optional<Fault> read_fault(Reading& reading) {
  Fault fault;
  const Place root{reading, reading.root()};
  if (read_object(root, fault_members(), fault)) check_fault(fault, "", "", reading);
  return reading.has_errors() ? std::nullopt : std::optional(std::move(fault));
}

FaultsReading read_faults(std::string_view text, const std::string& file,
                          std::string_view labels) try {
  const JsonSource source(text, file);
  refuse_other_kinds(source.root(), DataKind::kFaults, file);
  Reading reading(source, Unit::kMm);
  FaultPlan plan;
  read_object(Place{reading, reading.root()}, plan_members(), plan);
  check_faults(plan, labels, reading);
  const bool is_good = !reading.has_errors();
  return {is_good ? std::optional(std::move(plan)) : std::nullopt, reading.take_findings()};
} catch (const DataError& error) {
  return {std::nullopt, error.findings()};
}

FaultPlan load_faults(std::string_view text, const std::string& file, std::string_view labels) {
  FaultsReading reading = read_faults(text, file, labels);
  if (!reading.plan) throw DataError(std::move(reading.findings));
  return *std::move(reading.plan);
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
