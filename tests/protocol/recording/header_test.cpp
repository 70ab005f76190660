#include "protocol/recording/header.hpp"

#include <gtest/gtest.h>

#include "protocol/files/workcell.hpp"
#include "protocol/json/document.hpp"
#include "tests/support/models.hpp"

namespace xr3::recording {
namespace {

std::optional<Header> header_of(const Json& json, Findings* findings = nullptr) {
  const std::string text = json.dump();
  const JsonDocument document(text);
  data::Reading reading(document.root(), data::Unit::kMm);
  auto header = read_header(reading);
  if (findings != nullptr) *findings = reading.take_findings();
  return header;
}

Header full_header(const std::string& name) {
  Header header;
  header.program = "xr3 1";
  header.state_format = 4;
  header.cell = "main";
  header.model = std::make_shared<const Model>(test::robot_named(name), test::workcell_named(name),
                                               Profile::kMark3);
  header.mode = ClockMode::kManual;
  header.rate = {2'500'001};
  header.line_speed = LineSpeed{parse_serial_settings("1200-8n1"), {1'000'001}};
  Fault fault;
  fault.name = "stuck";
  fault.kind = FaultKind::kMotorStuck;
  fault.joint = 'E';
  fault.from_tick = 50;
  header.faults = FaultPlan{7, {fault}};
  return header;
}

TEST(RecordingHeader, TheModelOfEveryShippedRobotIsTheSameAfterwards) {
  for (const char* name : {"rhino-xr3", "adept-one", "intelledex-660"}) {
    const Header header = full_header(name);
    const auto read = header_of(header_to_json(header));
    ASSERT_TRUE(read) << name;
    EXPECT_TRUE(read->model->robot() == header.model->robot()) << name;
    EXPECT_TRUE(read->model->workcell() == header.model->workcell()) << name;
    EXPECT_EQ(read->model->profile(), Profile::kMark3);
    EXPECT_EQ(read->rate, header.rate);
    EXPECT_EQ(read->mode, ClockMode::kManual);
    EXPECT_EQ(read->line_speed, header.line_speed);
    EXPECT_EQ(read->faults, header.faults);
  }
}

TEST(RecordingHeader, WorkcellsOfEarlierVersionsMayBeLarger) {
  Workcell large = test::workcell_named("rhino-xr3");
  large.camera->pixels_y = kMaxSavedPixels;
  for (std::size_t i = large.blocks.size(); i <= kMaxFileBlocks; ++i) {
    large.blocks.edit().push_back(large.blocks[0]);
    large.blocks.edit().back().name = std::to_string(i);
  }
  Header header = full_header("rhino-xr3");
  header.model =
      std::make_shared<const Model>(test::robot_named("rhino-xr3"), large, Profile::kMark3);
  const auto read = header_of(header_to_json(header));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->model->workcell(), large);
}

TEST(RecordingHeader, TheByteClockSurvivesTheRoundTrip) {
  for (const std::optional<std::int64_t> settle_ms : {std::optional<std::int64_t>(), {250}}) {
    Header header = full_header("rhino-xr3");
    header.mode = ClockMode::kBytes;
    header.byte_clock = ByteClockSettings{35, settle_ms, true};
    const auto read = header_of(header_to_json(header));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->mode, ClockMode::kBytes);
    EXPECT_EQ(read->byte_clock, header.byte_clock);
  }
}

TEST(RecordingHeader, TheByteClockNeedsItsRulesAndNoOtherClockHasThem) {
  Json json = header_to_json(full_header("rhino-xr3"));
  json["clock"]["mode"] = "bytes";
  EXPECT_FALSE(header_of(json));
  json["byte_clock"] = {{"inquiry_ms", 20}, {"concurrent_lines", false}};
  EXPECT_TRUE(header_of(json));
  json["clock"]["mode"] = "manual";
  EXPECT_FALSE(header_of(json));
}

TEST(RecordingHeader, ADeviceSurvivesTheRoundTrip) {
  Header header = full_header("rhino-xr3");
  header.mode = ClockMode::kReal;
  header.rate = {};
  header.line_speed.reset();
  header.faults.reset();
  header.device = RecordedDevice{"/dev/tty\xff", *parse_serial_settings("9600-7e2"), true};
  const auto read = header_of(header_to_json(header));
  ASSERT_TRUE(read && read->device);
  EXPECT_EQ(read->device->path, "/dev/tty\xff");
  EXPECT_EQ(read->device->settings, header.device->settings);
  EXPECT_TRUE(read->device->is_mirrored);
}

TEST(RecordingHeader, PartsThatDoNotFitAreRefusedWithTheirPointer) {
  const auto pointer = [](const std::function<void(Json&)>& change) {
    Json json = header_to_json(full_header("rhino-xr3"));
    change(json);
    Findings findings;
    return header_of(json, &findings) ? std::string("accepted") : findings.front().pointer;
  };
  EXPECT_EQ(pointer([](Json&) {}), "accepted");
  EXPECT_EQ(pointer([](Json& json) { json.erase("robot"); }), "/robot");
  EXPECT_EQ(pointer([](Json& json) { json["robot"]["name"] = 5; }), "/robot/name");
  EXPECT_EQ(pointer([](Json& json) { json["workcell"].erase("blocks"); }), "/workcell/blocks");
  EXPECT_EQ(pointer([](Json& json) { json["faults"]["faults"][0]["joint"] = "H"; }),
            "/faults/faults/0/joint");
  EXPECT_EQ(pointer([](Json& json) { json["clock"]["mode"] = "bytes"; }), "/byte_clock");
  EXPECT_EQ(pointer([](Json& json) { json["clock"]["mode"] = "sundial"; }), "/clock/mode");
  EXPECT_EQ(pointer([](Json& json) {
              json["device"] = {{"path", "x"}, {"settings", "9600-7e2"}, {"mirrored", false}};
            }),
            "/device");
  EXPECT_EQ(pointer([](Json& json) { json["more"] = 1; }), "/more");
}

}  // namespace
}  // namespace xr3::recording
