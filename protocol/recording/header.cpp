#include "protocol/recording/header.hpp"

#include <functional>
#include <memory>
#include <utility>

#include "protocol/files/faults.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/values.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/recording/byte_text.hpp"

namespace xr3::recording {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr std::size_t kMaxName = 200;
constexpr std::size_t kMaxPath = 4096;
constexpr int kMaxVersion = 1'000'000;
constexpr int kMaxRevision = 1 << 30;

struct RecordedClock {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};

/// The rate means nothing to a clock that counts bytes.
RecordedClock effective(const RecordedClock& clock) {
  return {clock.mode, clock.mode == ClockMode::kBytes ? Rate{} : clock.rate};
}

/// A header before its parts are put together.
struct Parts {
  int format = 0;
  std::string program;
  int state_format = 0;
  std::string cell;
  Profile profile = Profile::kPaper;
  std::optional<Robot> robot;
  Workcell workcell;
  std::optional<FaultPlan> faults;
  RecordedClock clock{ClockMode::kManual, {}};
  std::optional<ByteClockSettings> byte_clock;
  std::optional<LineSpeed> line_speed;
  std::optional<RecordedDevice> device;
  std::optional<ContinuedState> start;
  std::string check;
};

/// A document in the form of a file; `read` reads its text.
template <class V>
Codec<V> document(const std::string& what,
                  const std::function<FileReading<V>(const std::string& text)>& read,
                  Json (*write)(const V&)) {
  const std::string form = what + " in the form of its file";
  const auto read_place = [read, form](const Place& place, V& value) {
    if (!place.value.is_object()) return place.refuse(form);
    FileReading<V> reading = read(place.value.to_json().dump());
    place.reading.refuse_part(place.value.pointer_from(place.reading.root()), reading.findings);
    if (reading.value) value = *std::move(reading.value);
    return reading.value.has_value();
  };
  return {form, read_place, write};
}

Codec<SerialSettings> serial_settings() {
  return parsed<SerialSettings>(
      "settings such as \"9600-7e2\"",
      [](JsonValue value) -> std::optional<SerialSettings> {
        const auto read =
            value.is_text() ? parse_serial_settings(value.text(kMaxName)) : std::nullopt;
        return read && read->frame ? read : std::nullopt;
      },
      [](const SerialSettings& settings) { return Json(text_of(settings)); });
}

/// A factor or rate in millionths.
Codec<Rate> millionths() {
  return converted<Rate, std::int64_t>(
      integer<std::int64_t>(kSlowest.millionths, kFastest.millionths),
      [](const std::int64_t& millionths) { return Rate{millionths}; },
      [](const Rate& rate) { return rate.millionths; });
}

Members<LineSpeed> line_speed_members() {
  return {optional("settings", &LineSpeed::settings, serial_settings()),
          required("factor_millionths", &LineSpeed::factor, millionths())};
}

Members<ByteClockSettings> byte_clock_members() {
  using Settings = ByteClockSettings;
  return {required("inquiry_ms", &Settings::inquiry_ms,
                   integer<std::int64_t>(0, Settings::kMaxInquiryMs)),
          optional("settle_ms", &Settings::settle_ms,
                   integer<std::int64_t>(Settings::kMinSettleMs, Settings::kMaxSettleMs)),
          required("concurrent_lines", &Settings::has_concurrent_lines, boolean())};
}

Members<RecordedClock> clock_members() {
  return {required("mode", &RecordedClock::mode,
                   choice<ClockMode>({{"real", ClockMode::kReal},
                                      {"manual", ClockMode::kManual},
                                      {"bytes", ClockMode::kBytes}})),
          required("rate_millionths", &RecordedClock::rate, millionths())};
}

Members<RecordedDevice> device_members() {
  return {required("path", &RecordedDevice::path, byte_text(kMaxPath)),
          required("settings", &RecordedDevice::settings, serial_settings()),
          required("mirrored", &RecordedDevice::is_mirrored, boolean())};
}

Codec<SavedCell> saved_cell() {
  const std::string form = "a snapshot, as snapshot_save gives it";
  const auto read = [form](const Place& place, SavedCell& value) {
    if (!place.value.is_object()) return place.refuse(form);
    Reading reading(place.value, Unit::kMm);
    std::optional<SavedCell> saved = read_saved_cell(reading);
    place.reading.adopt(reading);
    if (!saved) return false;
    value = *std::move(saved);
    return true;
  };
  return {form, read, saved_cell_to_json};
}

Members<ContinuedState> start_members() {
  using Named = ContinuedState::NamedState;
  constexpr std::size_t kMostSnapshots = 64;
  const Members<Named> named = {required("name", &Named::name, text(1, kMaxName)),
                                required("state", &Named::saved, saved_cell())};
  return {
      required("origin", &ContinuedState::origin, text(1, kMaxName)),
      required("epoch", &ContinuedState::epoch, integer<Epoch>(0, monitor::kMaxInteger)),
      optional("us", &ContinuedState::us, whole_number(0, 999)),
      required("model_rev", &ContinuedState::model_rev, whole_number(1, kMaxRevision)),
      required("last_line", &ContinuedState::last_line, integer<LineId>(0, monitor::kMaxInteger)),
      optional("past_was_manual", &ContinuedState::past_was_manual, boolean()),
      optional("freeze_was_manual", &ContinuedState::freeze_was_manual, boolean()),
      required("state", &ContinuedState::saved, saved_cell()),
      optional("snapshots", &ContinuedState::snapshots, list(object(named), 0, kMostSnapshots))};
}

const Members<Parts>& header_members() {
  static const Members<Parts> members = {
      required("xr3_recording", &Parts::format, whole_number(kFormat, kFormat)),
      required("program", &Parts::program, text(1, kMaxName)),
      required("state_format", &Parts::state_format, whole_number(1, kMaxVersion)),
      required("cell", &Parts::cell, text(1, kMaxName)),
      required("profile", &Parts::profile,
               choice<Profile>({{"paper", Profile::kPaper}, {"mark3", Profile::kMark3}})),
      required(
          "clock", &Parts::clock,
          converted<RecordedClock, RecordedClock>(object(clock_members()), effective, effective)),
      optional("byte_clock", &Parts::byte_clock, object(byte_clock_members())),
      optional("line_speed", &Parts::line_speed, object(line_speed_members())),
      optional("device", &Parts::device, object(device_members())),
      optional(
          "faults", &Parts::faults,
          document<FaultPlan>(
              "faults", [](const auto& text) { return read_faults(text, ""); }, faults_to_json)),
      optional(
          "robot", &Parts::robot,
          document<Robot>(
              "a robot", [](const auto& text) { return read_robot(text, ""); }, robot_to_json)),
      required("workcell", &Parts::workcell,
               document<Workcell>(
                   "a workcell",
                   [](const auto& text) {
                     return read_workcell(text, "", nullptr, 0, WorkcellBounds::kSaved);
                   },
                   workcell_to_json)),
      optional("start", &Parts::start, object(start_members())),
      optional("c", &Parts::check, text(0, kMaxName))};
  return members;
}

void check_parts(const Parts& parts, Reading& reading) {
  const bool is_paused = parts.start && parts.clock.mode == ClockMode::kManual;
  if ((parts.clock.mode == ClockMode::kBytes) != parts.byte_clock.has_value() && !is_paused)
    reading.refuse("/byte_clock", parts.byte_clock ? "rules" : "",
                   "the rules of the byte clock, if the mode of the clock is bytes");
  if (!parts.robot && reading.is_sound("/robot"))
    return reading.refuse("/robot", "", "a robot in the form of its file");
  const bool is_real = parts.clock.mode == ClockMode::kReal && parts.clock.rate == Rate{};
  if (parts.device && (!is_real || parts.line_speed || parts.faults || parts.start))
    reading.refuse("/device", "a device",
                   "none with faults, a line speed, a start or another clock");
}

/// The joints of the faults must be the robot's.
void check_joints(const Model& model, const FaultPlan& plan, Reading& reading) {
  reading.refuse_part("/faults",
                      read_faults(faults_to_json(plan).dump(), "", model.labels()).findings);
}

/// The states must be some that the robot can reach.
void check_start(const Model& model, const ContinuedState& start, Reading& reading) {
  const auto check = [&](const SavedCell& saved, const std::string& pointer) {
    for (const monitor::Detail& each : monitor::validate(model, saved))
      reading.refuse(pointer + each.pointer, shown(each.found), each.allowed);
  };
  if (!(start.saved.workcell == model.workcell()))
    reading.refuse("/start/state/workcell", "another one", "the workcell of the recording");
  check(start.saved, "/start/state");
  for (std::size_t i = 0; i < start.snapshots.size(); ++i)
    check(start.snapshots[i].saved, child_pointer("/start/snapshots", i) + "/state");
}

}  // namespace

Json header_to_json(const Header& header) {
  Parts parts;
  parts.format = kFormat;
  parts.program = header.program;
  parts.state_format = header.state_format;
  parts.cell = header.cell;
  parts.profile = header.model->profile();
  parts.robot = header.model->robot();
  parts.workcell = header.model->workcell();
  parts.faults = header.faults;
  parts.clock = {header.mode, header.rate};
  parts.byte_clock = header.byte_clock;
  parts.line_speed = header.line_speed;
  parts.device = header.device;
  parts.start = header.start;
  return write_object(parts, header_members());
}

std::optional<int> format_of(JsonValue line) {
  const JsonValue format = line.is_object() ? line.find("xr3_recording") : JsonValue();
  const auto number = detail::integer_in(format, 1, kMaxVersion);
  return number ? std::optional(static_cast<int>(*number)) : std::nullopt;
}

std::optional<Header> read_header(Reading& reading) {
  Parts parts;
  read_object(Place{reading, reading.root()}, header_members(), parts);
  check_parts(parts, reading);
  if (reading.has_errors()) return std::nullopt;
  const auto [mode, rate] = parts.clock;
  auto model = std::make_shared<const Model>(*parts.robot, parts.workcell, parts.profile);
  Header header{parts.program,
                parts.state_format,
                parts.cell,
                std::move(model),
                mode,
                rate,
                parts.byte_clock,
                parts.line_speed,
                parts.faults,
                parts.device,
                std::move(parts.start)};
  if (header.faults) check_joints(*header.model, *header.faults, reading);
  if (header.start) check_start(*header.model, *header.start, reading);
  return reading.has_errors() ? std::nullopt : std::optional(std::move(header));
}

}  // namespace xr3::recording
