#include "protocol/recording/header.hpp"

#include <memory>
#include <utility>

#include "protocol/files/faults.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/values.hpp"
#include "protocol/recording/byte_text.hpp"

namespace xr3::recording {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr std::size_t kMaxName = 200;
constexpr std::size_t kMaxPath = 4096;
constexpr int kMaxVersion = 1'000'000;

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
  SimClock clock = SimClock::manual();
  std::optional<ByteClockSettings> byte_clock;
  std::optional<LineSpeed> line_speed;
  std::optional<RecordedDevice> device;
  std::string check;
};

/// A document in the form of a file. `read` reads its text; its findings have pointers within it.
template <class V, class Read>
Codec<V> document(const std::string& what, const Read& read) {
  Codec<V> codec;
  codec.allowed = what + " in the form of its file";
  codec.read = [read, allowed = codec.allowed](const Place& place, V& value) {
    if (!place.value.is_object()) return place.refuse(allowed);
    auto reading = read(place.value.to_json().dump());
    const std::string pointer = place.value.pointer_from(place.reading.root());
    for (const Finding& finding : reading.findings) {
      if (finding.severity == Severity::kError)
        place.reading.refuse(pointer + finding.pointer, finding.found, finding.allowed);
    }
    if (reading.value) value = *std::move(reading.value);
    return reading.value.has_value();
  };
  return codec;
}

template <class V>
struct DocumentReading {
  std::optional<V> value;
  Findings findings;
};

Codec<Robot> robot_document() {
  auto codec = document<Robot>("a robot", [](const std::string& text) {
    RobotReading reading = read_robot(text, "");
    return DocumentReading<Robot>{std::move(reading.robot), std::move(reading.findings)};
  });
  codec.write = robot_to_json;
  return codec;
}

Codec<Workcell> workcell_document() {
  auto codec = document<Workcell>("a workcell", [](const std::string& text) {
    WorkcellReading reading = read_workcell(text, "");
    return DocumentReading<Workcell>{std::move(reading.workcell), std::move(reading.findings)};
  });
  codec.write = workcell_to_json;
  return codec;
}

Codec<FaultPlan> faults_document() {
  auto codec = document<FaultPlan>("faults", [](const std::string& text) {
    FaultsReading reading = read_faults(text, "");
    return DocumentReading<FaultPlan>{std::move(reading.plan), std::move(reading.findings)};
  });
  codec.write = faults_to_json;
  return codec;
}

Codec<SerialSettings> serial_settings() {
  Codec<SerialSettings> codec;
  codec.allowed = "settings such as \"9600-7e2\"";
  codec.read = [allowed = codec.allowed](const Place& place, SerialSettings& settings) {
    const auto read =
        place.value.is_text() ? parse_serial_settings(place.value.text(kMaxName)) : std::nullopt;
    if (!read || !read->frame) return place.refuse(allowed);
    return settings = *read, true;
  };
  codec.write = [](const SerialSettings& settings) { return Json(text_of(settings)); };
  return codec;
}

/// A factor or rate in millionths.
Codec<Rate> millionths() {
  const auto number = integer<std::int64_t>(kSlowest.millionths, kFastest.millionths);
  Codec<Rate> codec;
  codec.allowed = number.allowed;
  codec.read = [number](const Place& place, Rate& rate) {
    return number.read(place, rate.millionths);
  };
  codec.write = [](const Rate& rate) { return Json(rate.millionths); };
  return codec;
}

Codec<LineSpeed> line_speed() {
  Codec<LineSpeed> codec =
      object(Members<LineSpeed>{optional("settings", &LineSpeed::settings, serial_settings()),
                                required("factor_millionths", &LineSpeed::factor, millionths())});
  return codec;
}

SimClock clock_of(ClockMode mode, Rate rate) {
  if (mode == ClockMode::kBytes) return SimClock::bytes();
  SimClock clock = SimClock::real(rate, 0);
  if (mode == ClockMode::kManual) clock.pause(0);
  return clock;
}

Codec<ByteClockSettings> byte_clock() {
  using Settings = ByteClockSettings;
  return object(Members<Settings>{
      required("inquiry_ms", &Settings::inquiry_ms,
               integer<std::int64_t>(0, Settings::kMaxInquiryMs)),
      optional("settle_ms", &Settings::settle_ms,
               integer<std::int64_t>(Settings::kMinSettleMs, Settings::kMaxSettleMs)),
      required("concurrent_lines", &Settings::has_concurrent_lines, boolean())});
}

struct ClockParts {
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};

Codec<SimClock> clock_codec() {
  const auto parts =
      object(Members<ClockParts>{required("mode", &ClockParts::mode,
                                          choice<ClockMode>({{"real", ClockMode::kReal},
                                                             {"manual", ClockMode::kManual},
                                                             {"bytes", ClockMode::kBytes}})),
                                 required("rate_millionths", &ClockParts::rate, millionths())});
  Codec<SimClock> codec;
  codec.allowed = parts.allowed;
  codec.read = [parts](const Place& place, SimClock& clock) {
    ClockParts read;
    if (!parts.read(place, read)) return false;
    clock = clock_of(read.mode, read.rate);
    return true;
  };
  codec.write = [parts](const SimClock& clock) {
    return parts.write({clock.mode(), clock.rate()});
  };
  return codec;
}

Codec<RecordedDevice> recorded_device() {
  return object(
      Members<RecordedDevice>{required("path", &RecordedDevice::path, byte_text(kMaxPath)),
                              required("settings", &RecordedDevice::settings, serial_settings()),
                              required("mirrored", &RecordedDevice::is_mirrored, boolean())});
}

const Members<Parts>& header_members() {
  static const Members<Parts> members = {
      required("xr3_recording", &Parts::format, whole_number(kFormat, kFormat)),
      required("program", &Parts::program, text(1, kMaxName)),
      required("state_format", &Parts::state_format, whole_number(1, kMaxVersion)),
      required("cell", &Parts::cell, text(1, kMaxName)),
      required("profile", &Parts::profile,
               choice<Profile>({{"paper", Profile::kPaper}, {"mark3", Profile::kMark3}})),
      required("clock", &Parts::clock, clock_codec()),
      optional("byte_clock", &Parts::byte_clock, byte_clock()),
      optional("line_speed", &Parts::line_speed, line_speed()),
      optional("device", &Parts::device, recorded_device()),
      optional("faults", &Parts::faults, faults_document()),
      optional("robot", &Parts::robot, robot_document()),
      required("workcell", &Parts::workcell, workcell_document()),
      optional("c", &Parts::check, text(0, kMaxName))};
  return members;
}

void check_parts(const Parts& parts, Reading& reading) {
  if ((parts.clock.mode() == ClockMode::kBytes) != parts.byte_clock.has_value())
    reading.refuse("/byte_clock", parts.byte_clock ? "rules" : "",
                   "the rules of the byte clock, if the mode of the clock is bytes");
  if (!parts.robot && reading.is_sound("/robot"))
    return reading.refuse("/robot", "", "a robot in the form of its file");
  const bool is_real = parts.clock.mode() == ClockMode::kReal && parts.clock.rate() == Rate{};
  if (parts.device && (!is_real || parts.line_speed || parts.faults))
    reading.refuse("/device", "a device", "none with faults, a line speed or another clock");
}

/// The joints of the faults must be the robot's.
void check_joints(const Model& model, const FaultPlan& plan, Reading& reading) {
  const FaultsReading again = read_faults(faults_to_json(plan).dump(), "", model.labels());
  for (const Finding& finding : again.findings) {
    if (finding.severity == Severity::kError)
      reading.refuse("/faults" + finding.pointer, finding.found, finding.allowed);
  }
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
  parts.clock = clock_of(header.mode, header.rate);
  parts.byte_clock = header.byte_clock;
  parts.line_speed = header.line_speed;
  parts.device = header.device;
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
  Header header{parts.program,
                parts.state_format,
                parts.cell,
                std::make_shared<const Model>(*parts.robot, parts.workcell, parts.profile),
                parts.clock.mode(),
                parts.clock.rate(),
                parts.byte_clock,
                parts.line_speed,
                parts.faults,
                parts.device};
  if (header.faults) check_joints(*header.model, *header.faults, reading);
  return reading.has_errors() ? std::nullopt : std::optional(std::move(header));
}

}  // namespace xr3::recording
