// The robot in a page, natively.
#include "wasm/page_robot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "protocol/goals/vary.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

constexpr WallNs kMs = 1'000'000;

std::string contents(const std::string& path) {
  std::ifstream file(XR3_SOURCE_DIR "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
std::string data(const std::string& path) { return contents("data/" + path); }

/// The Rhino with its workcell, and further members of the setup.
PageSetup rhino_setup(const Json& more = Json::object()) {
  Json setup = {{"product", "xr3 test"},
                {"robot", data("robots/rhino-xr3.json")},
                {"workcell", data("workcells/rhino-xr3.json")}};
  setup.update(more);
  return read_setup(setup.dump());
}

std::string failure_of(const Json& more) {
  try {
    rhino_setup(more);
  } catch (const std::exception& failure) {
    return failure.what();
  }
  return "";
}

std::string ask(PageRobot& robot, LineId line, const std::string& bytes) {
  EXPECT_EQ(robot.send(line, bytes), bytes.size());
  return robot.receive(line, 100);
}

TEST(PageRobotTest, FollowsTheWallClock) {
  PageRobot robot(rhino_setup());
  const LineId line = robot.open_line();
  EXPECT_EQ(ask(robot, line, "E+50\rE?"), "R");
  robot.set_wall(100 * kMs);
  EXPECT_EQ(ask(robot, line, "E?"), "G") << "11 counts later";
  EXPECT_EQ(robot.cell().state().tick, 100);
  robot.set_wall(50 * kMs);
  robot.catch_up();
  EXPECT_EQ(robot.cell().state().tick, 100) << "never back";
}

TEST(PageRobotTest, TimePassesWithoutTheWallClock) {
  PageRobot robot(rhino_setup());
  robot.pass(2000);
  EXPECT_EQ(robot.cell().state().tick, 2000);
  EXPECT_EQ(robot.wall(), 2000 * kMs);
  PageRobot manual(rhino_setup({{"clock", "manual"}}));
  manual.pass(2000);
  EXPECT_EQ(manual.cell().state().tick, 0);
}

TEST(PageRobotTest, ALineCloses) {
  PageRobot robot(rhino_setup());
  const LineId line = robot.open_line();
  EXPECT_EQ(robot.waiting(line), 0U);
  robot.send(line, "E?");
  EXPECT_EQ(robot.waiting(line), 1U);
  robot.close_line(line);
  EXPECT_EQ(robot.waiting(line), std::nullopt);
  EXPECT_EQ(robot.send(line, "E?"), 0U);
  EXPECT_EQ(robot.receive(line, 1), "");
  robot.close_line(line);
}

TEST(PageRobotTest, ALineWhoseInputHasEndedClosesAfterItsReplies) {
  PageRobot robot(rhino_setup());
  const LineId line = robot.open_line();
  robot.send(line, "E?");
  robot.end_input(line);
  EXPECT_EQ(robot.waiting(line), 1U);
  EXPECT_EQ(robot.receive(line, 10), " ");
  EXPECT_EQ(robot.waiting(line), std::nullopt);
}

TEST(PageRobotTest, AFaultCutsALine) {
  PageRobot robot(rhino_setup(
      {{"faults", R"({"faults":[{"name":"cut","kind":"line_disconnected","at_tick":50}]})"}}));
  const LineId line = robot.open_line();
  EXPECT_EQ(ask(robot, line, "E?"), " ");
  robot.pass(100);
  EXPECT_EQ(robot.waiting(line), std::nullopt);
}

TEST(PageRobotTest, AWebBrowserIsNoRobotProgram) {
  PageRobot robot(rhino_setup());
  const LineId line = robot.open_line();
  robot.send(line, "GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  while (robot.waiting(line)) robot.receive(line, 1000);
  EXPECT_TRUE(robot.cell().lines().empty());
}

TEST(PageRobotTest, HasAMonitorForThePageAndOneForAProgram) {
  PageRobot robot(rhino_setup());
  for (std::size_t number : {0U, 1U}) {
    EXPECT_EQ(robot.add_monitor(), number);
    const Json hello = Json::parse(*robot.monitor(number).next_output(robot.wall()));
    EXPECT_EQ(hello["server"], "xr3 test");
    EXPECT_EQ(robot.monitor(number).next_output(robot.wall()), nullptr);
  }
}

TEST(PageRobotTest, ItsRecordingReplays) {
  PageRobot robot(rhino_setup({{"clock", "bytes"}}));
  const LineId line = robot.open_line();
  ask(robot, line, "E+50\r");
  std::string recording = robot.take_recording();
  for (int i = 0; i < 300; ++i) ask(robot, line, "E?");
  robot.close_line(line);
  const RunReport report = robot.finish("");
  recording += robot.take_recording();
  EXPECT_EQ(robot.take_recording(), "");
  EXPECT_EQ(report.transcript.substr(0, 7), "sha256:");
  const test::Replayed replayed = test::replay(recording);
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  EXPECT_EQ(replayed.state, robot.cell().state());
}

TEST(PageRobotTest, RepeatsTheRecordingOfAnotherOne) {
  PageRobot first(rhino_setup());
  const LineId line = first.open_line();
  ask(first, line, "E+50\r");
  first.set_wall(300 * kMs);
  ask(first, line, "E?");
  PageRobot second(rhino_setup());
  second.set_wall(7 * kMs);
  second.repeat(first.take_recording());
  EXPECT_EQ(second.cell().state(), first.cell().state());
  EXPECT_TRUE(second.cell().lines().empty());
  second.pass(100);
  EXPECT_EQ(second.cell().state().tick, 400);
  second.finish("");
  const std::string recording = second.take_recording();
  const test::Replayed replayed = test::replay(recording);
  EXPECT_EQ(replayed.difference ? to_text(*replayed.difference) : "", "");
  PageRobot third(rhino_setup());
  EXPECT_THROW(third.repeat("x"), std::exception);
}

/// The setup of the robot of a recording.
PageSetup setup_of(const std::string& recording) {
  return read_setup(
      Json{{"product", "xr3 test"}, {"recording", recording.substr(0, recording.find('\n') + 1)}}
          .dump());
}

TEST(PageRobotTest, OpensARecordingAndGoesOn) {
  const std::string recording = contents("docs/find-and-pick.xr3rec");
  PageRobot robot(setup_of(recording));
  robot.repeat(recording);
  EXPECT_EQ(robot.cell().state(), test::replay(recording).state);
  const Tick end = robot.cell().state().tick;
  EXPECT_GT(end, 10'000);
  ask(robot, robot.open_line(), "F+9\r");
  robot.finish("");
  EXPECT_GT(robot.cell().state().tick, end);
  const test::Replayed again = test::replay(robot.take_recording());
  EXPECT_EQ(again.difference ? to_text(*again.difference) : "", "");
  EXPECT_EQ(again.state, robot.cell().state());
}

TEST(PageRobotTest, OpensTheRecordingsOfAServer) {
  const std::filesystem::path folder = XR3_SOURCE_DIR "/tests/data/recordings/0.1.0";
  int opened = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string name = file.path().filename();
    if (name.starts_with("device") || name.starts_with("behind")) continue;
    const std::string recording = contents("tests/data/recordings/0.1.0/" + name);
    PageRobot robot(setup_of(recording));
    EXPECT_NO_THROW(robot.repeat(recording)) << file.path();
    EXPECT_EQ(robot.cell().lines().size(), 0U) << file.path();
    ++opened;
  }
  EXPECT_GT(opened, 30);
}

TEST(PageRobotTest, ARecordingThatCannotBeOpenedSaysWhy) {
  const std::string device = contents("tests/data/recordings/0.1.0/device.xr3rec");
  try {
    setup_of(device);
    FAIL() << "opened";
  } catch (const std::invalid_argument& failure) {
    EXPECT_NE(std::string(failure.what()).find("a physical controller at arm"), std::string::npos)
        << failure.what();
  }
  EXPECT_THROW(setup_of("no recording\n"), DataError);
  std::string recording = contents("docs/find-and-pick.xr3rec");
  PageRobot robot(setup_of(recording));
  recording[recording.size() / 2] ^= 1;
  EXPECT_THROW(robot.repeat(recording), DataError);
}

TEST(PageRobotTest, JudgesTheGoals) {
  const std::string goals = R"({"goals":[{"kind":"joint","label":"F","count":9,"points":3},)"
                            R"({"kind":"holding","name":"red"}]})";
  PageRobot robot(rhino_setup({{"goals", goals}}));
  EXPECT_EQ(robot.goals_now(), (std::vector<bool>{false, false}));
  ask(robot, robot.open_line(), "F+9\r");
  const RunReport good = robot.finish("");
  EXPECT_EQ(good.outcome, RunOutcome::kFinished);
  EXPECT_EQ(good.goals.at(0).earned(), 3);
  EXPECT_FALSE(good.goals.at(1).is_met);
  EXPECT_GT(good.ticks, 50) << "it came to rest";
  const RunReport failed = robot.finish("NameError");
  EXPECT_EQ(failed.outcome, RunOutcome::kFailed);
  EXPECT_EQ(failed.why, "NameError");
  EXPECT_EQ(points_of(failed.goals), 0);
}

TEST(PageRobotTest, AnInquiryTakesTheTimeOfTheByteClock) {
  PageRobot robot(rhino_setup({{"clock", "bytes:200"}}));
  ask(robot, robot.open_line(), "E?");
  EXPECT_GE(robot.cell().state().tick, 200);
  EXPECT_LT(robot.cell().state().tick, 220);
}

TEST(PageRobotTest, ASeedMovesTheBlocks) {
  const PageSetup moved = rhino_setup({{"vary", "7"}});
  EXPECT_EQ(moved.seed, 7U);
  EXPECT_EQ(moved.header.model->workcell(),
            *varied(rhino_setup().header.model->workcell(), moved.header.model->robot(), {7}));
  EXPECT_EQ(PageRobot(moved).finish("").seed, 7U);
}

TEST(PageRobotTest, AProgramHasSixHundredSimulatedSeconds) {
  const std::string goals = R"({"goals":[{"kind":"joint","label":"F","count":9}]})";
  PageRobot robot(rhino_setup({{"goals", goals}, {"clock", "bytes:60000"}}));
  const LineId line = robot.open_line();
  for (int i = 0; i < 9; ++i) ask(robot, line, "E?");
  EXPECT_FALSE(robot.is_time_up());
  ask(robot, line, "E?");
  EXPECT_TRUE(robot.is_time_up());
  ask(robot, line, "F+9\r");
  const RunReport report = robot.finish("stopped");
  EXPECT_EQ(report.outcome, RunOutcome::kTimeUp);
  EXPECT_EQ(report.why, "the limit of 600 simulated seconds was reached");
  EXPECT_EQ(report.ticks, 600'000);
  EXPECT_FALSE(report.goals.at(0).is_met);
}

TEST(PageRobotTest, FaultsAct) {
  PageRobot robot(rhino_setup(
      {{"faults", R"({"faults":[{"name":"mute","kind":"reply_lost","probability":1}]})"}}));
  EXPECT_EQ(ask(robot, robot.open_line(), "E?"), "");
}

TEST(PageRobotTest, ABadSetupIsRefusedWithTheReason) {
  EXPECT_NE(failure_of({{"robot", "{}"}}).find("robot:1: /"), std::string::npos);
  EXPECT_NE(failure_of({{"workcell", R"({"blocks":3})"}}).find("workcell:1: /"), std::string::npos);
  EXPECT_NE(failure_of({{"goals", R"({"goals":[{"kind":"x"}]})"}}).find("goals:1: /goals/0"),
            std::string::npos);
  EXPECT_EQ(failure_of({{"clock", "sun"}}),
            "clock: found sun; allowed: real, manual, bytes, bytes:INQUIRY_MS");
  EXPECT_EQ(failure_of({{"clock", "bytes:9,settle=50"}}),
            "clock: found bytes:9,settle=50; allowed in a page: bytes:INQUIRY_MS");
  EXPECT_NE(failure_of({{"clock", "bytes:x"}}).find("the byte clock is bytes:"), std::string::npos);
  EXPECT_NE(failure_of({{"vary", "x"}}).find("a variation is a seed"), std::string::npos);
  EXPECT_EQ(failure_of({{"compat", "x"}}), "compat: found x; allowed: paper, mark3");
  EXPECT_NE(failure_of({{"robot", 3}}).find("the setup of the robot"), std::string::npos);
  EXPECT_THROW(read_setup("{"), std::invalid_argument);
}

TEST(PageRobotTest, WithoutAWorkcellTheTableIsEmpty) {
  const PageSetup setup = rhino_setup({{"workcell", ""}});
  EXPECT_TRUE(setup.header.model->workcell().blocks.empty());
}

}  // namespace
}  // namespace xr3
