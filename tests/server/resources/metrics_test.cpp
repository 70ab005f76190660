// The metrics page, parsed line by line as Prometheus would.
#include "server/resources/metrics.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace xr3 {
namespace {

CellCounters some_counters() {
  CellCounters counters;
  counters.lines_open = 2;
  counters.lines_total = 7;
  counters.of(LineCloseReason::kNotARobotProgram) = 2;
  counters.bytes_in = 123;
  counters.bytes_out = 45;
  counters.of(Command(Move{'E', 5})) = 9;
  counters.of(Command(CameraPixel{0, 0})) = 1;
  counters.warnings["number_out_of_range"] = 3;
  counters.ticks = 12'345;
  counters.recordings_failed = 10;
  counters.of(monitor::Channel::kState) = {100, 4};
  counters.monitor_sessions = 6;
  counters.wrong_tokens = 8;
  counters.robot_port = {11, 12};
  counters.monitor_port = {13, 14};
  counters.lines_max = 15;
  counters.allocated_bytes = 16;
  counters.allocated_max = 17;
  counters.recording_room = 18;
  counters.loop_lag_ns = 2'500'000;
  return counters;
}

const ProcessStats kProcess{1.5, 4096, 17, 1024};

/// Samples by name and labels. Every line must be a comment, or a sample of the metric that the
/// preceding comments name.
std::map<std::string, double> parsed(const std::string& text) {
  const std::regex help(R"(# HELP ((?:xr3|process)_[a-z_]+) \S.*\.)");
  const std::regex type(R"(# TYPE ((?:xr3|process)_[a-z_]+) (counter|gauge))");
  const std::regex sample(
      R"(((?:xr3|process)_[a-z_]+)((?:\{[a-z]+="[^"\\\n]*"(?:,[a-z]+="[^"\\\n]*")*\})?) (\S+))");
  std::map<std::string, double> samples;
  std::set<std::string> names;
  std::string helped;
  std::string typed;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, help)) {
      helped = match[1];
      EXPECT_TRUE(names.insert(helped).second) << line;
    } else if (std::regex_match(line, match, type)) {
      typed = match[1];
      EXPECT_EQ(typed, helped);
      EXPECT_EQ(match[2] == "counter", typed.ends_with("_total")) << line;
    } else if (std::regex_match(line, match, sample)) {
      EXPECT_EQ(match[1], typed);
      const bool is_new =
          samples.emplace(match[1].str() + match[2].str(), std::stod(match[3])).second;
      EXPECT_TRUE(is_new) << line;
    } else {
      ADD_FAILURE() << line;
    }
  }
  return samples;
}

TEST(Metrics, EveryCounterHasASample) {
  const std::string text = metrics_text("main", some_counters(), kProcess);
  EXPECT_TRUE(text.ends_with('\n'));
  const auto samples = parsed(text);
  const std::map<std::string, double> expected{
      {R"(xr3_lines_open{cell="main"})", 2},
      {R"(xr3_lines_total{cell="main"})", 7},
      {R"(xr3_lines_max{cell="main"})", 15},
      {R"(xr3_allocated_bytes{cell="main"})", 16},
      {R"(xr3_allocated_max_bytes{cell="main"})", 17},
      {R"(xr3_recording_room_bytes{cell="main"})", 18},
      {R"(xr3_bytes_in_total{cell="main"})", 123},
      {R"(xr3_bytes_out_total{cell="main"})", 45},
      {R"(xr3_commands_total{cell="main",kind="move"})", 9},
      {R"(xr3_commands_total{cell="main",kind="camera_pixel"})", 1},
      {R"(xr3_commands_total{cell="main",kind="stop"})", 0},
      {R"(xr3_warnings_total{cell="main",code="number_out_of_range"})", 3},
      {R"(xr3_ticks_total{cell="main"})", 12'345},
      {R"(xr3_simulated_seconds_total{cell="main"})", 12.345},
      {R"(xr3_recordings_failed_total{cell="main"})", 10},
      {R"(xr3_viewers{cell="main"})", 6},
      {R"(xr3_frames_sent_total{cell="main",channel="state"})", 100},
      {R"(xr3_frames_overwritten_total{cell="main",channel="state"})", 4},
      {R"(xr3_wrong_tokens_total{cell="main"})", 8},
      {R"(xr3_lines_closed_total{cell="main",reason="stranger"})", 2},
      {R"(xr3_lines_closed_total{cell="main",reason="client_closed"})", 0},
      {R"(xr3_lines_refused_total{cell="main"})", 11},
      {R"(xr3_viewers_refused_total{cell="main"})", 13},
      {R"(xr3_accept_failures_total{cell="main",port="robot"})", 12},
      {R"(xr3_accept_failures_total{cell="main",port="monitor"})", 14},
      {R"(xr3_event_loop_lag_seconds{cell="main"})", 0.0025},
      {"process_cpu_seconds_total", 1.5},
      {"process_resident_memory_bytes", 4096},
      {"process_open_fds", 17},
      {"process_max_fds", 1024},
      {R"(xr3_frames_sent_total{cell="main",channel="line"})", 0}};
  for (const auto& [name, value] : expected) {
    ASSERT_TRUE(samples.contains(name)) << name;
    EXPECT_EQ(samples.at(name), value) << name;
  }
  EXPECT_EQ(samples.size(), 25 + kLineCloseReasons + kCommandKinds + 1 + 2 * kChannels);
}

TEST(Metrics, SumsOfManyCellsNameNoCell) {
  const auto samples = parsed(metrics_text("", some_counters(), kProcess));
  EXPECT_EQ(samples.at("xr3_lines_total"), 7);
  EXPECT_EQ(samples.at(R"(xr3_commands_total{kind="move"})"), 9);
  for (const auto& [name, value] : samples)
    EXPECT_EQ(name.find("cell="), std::string::npos) << name;
}

TEST(Metrics, WhatTheSystemDoesNotTellIsAbsent) {
  const auto samples = parsed(metrics_text("main", some_counters(), {}));
  for (const auto& [name, value] : samples) EXPECT_FALSE(name.starts_with("process_")) << name;
}

TEST(Metrics, WithoutRecordingsThereIsNoRoomForThem) {
  const auto samples = parsed(metrics_text("main", {}, kProcess));
  EXPECT_FALSE(samples.contains(R"(xr3_recording_room_bytes{cell="main"})"));
}

TEST(Metrics, LargeCountsAreNotRounded) {
  CellCounters counters;
  counters.bytes_in = 9'007'199'254'740'991;
  EXPECT_EQ(
      parsed(metrics_text("main", counters, kProcess)).at(R"(xr3_bytes_in_total{cell="main"})"),
      9'007'199'254'740'991.0);
}

}  // namespace
}  // namespace xr3
