// Fault files: what they mean, that they are read back as written, and the joints of the robot.
// The findings in broken ones are in broken_files_test.cpp.
#include "protocol/files/faults.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "protocol/explain/fault_text.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

/// The example of the documentation.
constexpr std::string_view kExample = R"({"seed":7,"faults":[
 {"name":"lost","kind":"reply_lost","line":1,"after_bytes":3,"count":1},
 {"name":"slip","kind":"encoder_slip","joint":"E","probability":0.01,"from_tick":0,"ticks":60000},
 {"name":"stuck","kind":"switch_stuck_open","joint":"E","at_tick":5000}]})";

FaultPlan plan_of(std::string_view text) { return load_faults(text, "faults.json", ""); }

Fault only_fault(const std::string& members) {
  return plan_of(R"({"faults":[{"name":"x",)" + members + "}]}").faults.at(0);
}

TEST(FaultFile, TheExampleMeansWhatItSays) {
  const FaultPlan plan = plan_of(kExample);
  EXPECT_EQ(plan.seed, 7U);
  ASSERT_EQ(plan.faults.size(), 3U);
  const Fault& lost = plan.faults[0];
  EXPECT_EQ(lost.kind, FaultKind::kReplyLost);
  EXPECT_EQ(lost.line, 1U);
  EXPECT_EQ(lost.after_bytes, 3U);
  EXPECT_EQ(lost.limit(), 1U);
  const Fault& slip = plan.faults[1];
  EXPECT_EQ(slip.joint, 'E');
  EXPECT_EQ(slip.chance, 10'000'000U);
  EXPECT_EQ(slip.end(), 60'000);
  const Fault& stuck = plan.faults[2];
  EXPECT_FALSE(stuck.covers(4999));
  EXPECT_TRUE(stuck.covers(5000));
  EXPECT_EQ(stuck.end(), kNoTick);
}

TEST(FaultFile, AFaultOfBytesAtATickHappensOnceUnlessItSaysHowLong) {
  EXPECT_EQ(only_fault(R"("kind":"byte_dropped","at_tick":5)").limit(), 1U);
  EXPECT_EQ(only_fault(R"("kind":"byte_dropped","after_bytes":5)").limit(), 1U);
  EXPECT_EQ(only_fault(R"("kind":"byte_dropped","after_bytes":5,"count":4)").limit(), 4U);
  EXPECT_GT(only_fault(R"("kind":"byte_dropped","at_tick":5,"ticks":9)").limit(), 1'000'000'000U);
  EXPECT_GT(only_fault(R"("kind":"byte_dropped","from_tick":5)").limit(), 1'000'000'000U);
  EXPECT_GT(only_fault(R"("kind":"wrong_baud","after_bytes":5)").limit(), 1'000'000'000U);
}

TEST(FaultFile, IsReadBackAsWritten) {
  std::vector<std::string> texts{std::string(kExample)};
  for (const char* name : {"worn-arm", "noisy-line"})
    texts.push_back(test::project_file("data/faults/" + std::string(name) + ".json"));
  texts.push_back(R"({"faults":[
    {"name":"a","kind":"stray_byte","byte":0,"direction":"out","from_tick":0},
    {"name":"b","kind":"camera_dead_row","row":0,"from_tick":0},
    {"name":"c","kind":"camera_offset","rows":-3,"at_tick":0},
    {"name":"d","kind":"camera_offset","columns":0,"at_tick":0},
    {"name":"e","kind":"byte_flipped","bit":0,"line":"any","probability":0.000000001},
    {"name":"f","kind":"reply_batched","period_ms":5,"from_tick":1,"ticks":2},
    {"name":"g","kind":"camera_noise","probability":0.123456789,"from_tick":7}]})");
  for (const std::string& text : texts) {
    const FaultPlan plan = plan_of(text);
    EXPECT_EQ(plan_of(faults_to_json(plan).dump()), plan) << text;
  }
}

TEST(FaultFile, EveryProbabilityOfABillionthIsKept) {
  for (std::uint32_t parts = 1; parts <= kCertain - 12'345'679; parts += 12'345'679) {
    Fault fault = only_fault(R"("kind":"byte_dropped","probability":0.5)");
    fault.chance = parts;
    const Json json = {{"faults", Json::array({fault_to_json(fault)})}};
    ASSERT_EQ(plan_of(json.dump()).faults[0].chance, parts);
  }
}

TEST(FaultFile, MayNotNameAJointThatTheRobotLacks) {
  const std::string text =
      R"({"faults":[{"name":"x","kind":"motor_stuck","joint":"G","at_tick":0}]})";
  EXPECT_TRUE(read_faults(text, "f").value);
  const FileReading<FaultPlan> reading = read_faults(text, "f", "ABCDEF");
  ASSERT_EQ(reading.findings.size(), 1U);
  EXPECT_EQ(to_text(reading.findings[0]),
            "f:1: /faults/0/joint: found \"G\"; allowed: a joint of the robot: one of ABCDEF");
}

TEST(FaultFile, AnotherKindOfFileIsOneFinding) {
  EXPECT_EQ(to_text(read_faults(test::project_file("data/robots/rhino-xr3.json"), "f").findings),
            "f:1: found a robot; allowed: a fault file, with \"faults\"\n");
}

TEST(FaultFile, EveryKindHasANameOfItsOwnAndASentence) {
  std::set<std::string_view> names;
  std::set<std::string> sentences;
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    FaultNews news;
    news.kind = static_cast<FaultKind>(i);
    news.fault = "x";
    names.insert(code_of(news.kind));
    sentences.insert(text_of(news));
  }
  EXPECT_EQ(names.size(), kFaultKinds);
  EXPECT_EQ(sentences.size(), kFaultKinds);
}

}  // namespace
}  // namespace xr3
