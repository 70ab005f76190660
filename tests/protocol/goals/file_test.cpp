// Goals files: what they mean, and the findings in broken ones.
#include "protocol/goals/file.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

const Model& rhino_of_goals() {
  static const Model model(test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"),
                           Profile::kPaper);
  return model;
}

Goal only_goal(const std::string& members) {
  return load_goals(R"({"goals":[{)" + members + "}]}", "goals.json", rhino_of_goals()).goals.at(0);
}

/// The findings about one goal, a line each: pointer, found, allowed.
std::string goal_findings(const std::string& members) {
  std::string text;
  for (const Finding& each :
       read_goals(R"({"goals":[{)" + members + "}]}", "goals.json", &rhino_of_goals()).findings)
    text += each.pointer + ": " + each.found + " / " + each.allowed + "\n";
  return text;
}

bool starts_with(const std::string& text, const std::string& beginning) {
  return text.starts_with(beginning);
}

template <class Body>
Body only_body(const std::string& members) {
  return std::get<Body>(only_goal(members).body);
}

TEST(GoalsFile, ABlockAtAPoint) {
  const Goal goal = only_goal(
      R"("kind":"block","name":"red","xyz_mm":[400,-12.5,null],"mm":8,"yaw_deg":90,"deg":3,)"
      R"("points":4,"hint":"look")");
  EXPECT_EQ(goal.points, 4);
  EXPECT_EQ(goal.hint, "look");
  const auto& body = std::get<goal::BlockPlace>(goal.body);
  EXPECT_EQ(body.name, "red");
  EXPECT_EQ(body.point, (PartialPoint{400'000, -12'500, std::nullopt}));
  EXPECT_EQ(body.within_um, 8'000);
  EXPECT_EQ(body.yaw_udeg, 90'000'000);
  EXPECT_EQ(body.within_udeg, 3'000'000);
  EXPECT_FALSE(body.may_be_held);
}

TEST(GoalsFile, AFailedProgramCountsIfTheFileSaysSo) {
  const auto list = [](const std::string& member) {
    return load_goals("{" + member + R"("goals":[{"kind":"no_stall"}]})", "goals.json",
                      rhino_of_goals());
  };
  EXPECT_FALSE(list("").failed_program_counts);
  EXPECT_TRUE(list(R"("failed_program":"counts",)").failed_program_counts);
}

TEST(GoalsFile, EachKindOfGoal) {
  using namespace goal;  // NOLINT: the kinds
  const auto box = only_body<BlockPlace>(
      R"("kind":"block","name":"red","box_mm":[[100,50,0],[-100,-50,40]],"held":true)");
  EXPECT_EQ(box.box, (BoxUm{{-100'000, -50'000, 0}, {100'000, 50'000, 40'000}}));
  EXPECT_TRUE(box.may_be_held);
  const auto relative =
      only_body<BlockPlace>(R"("kind":"block","name":"red","at":"green","offset_mm":[0,null,40])");
  EXPECT_EQ(relative.at, "green");
  EXPECT_EQ(relative.offset, (PartialPoint{0, std::nullopt, 40'000}));
  EXPECT_EQ(only_body<Stacked>(R"("kind":"stacked","name":"red","on":"blue")"),
            (Stacked{"red", "blue"}));
  EXPECT_EQ(only_body<Sorted>(R"("kind":"sorted","by":"height","along":"-y")"),
            (Sorted{{}, SortKey::kHeight, SortAxis::kMinusY}));
  EXPECT_EQ(only_body<Holding>(R"("kind":"holding","name":null)").name, std::nullopt);
  EXPECT_EQ(only_body<Holding>(R"("kind":"holding","name":"red")").name, "red");
  EXPECT_EQ(only_body<JointValue>(R"("kind":"joint","label":"E","count":7,"within":1)"),
            (JointValue{'E', std::nullopt, 7, 1}));
  EXPECT_EQ(only_body<TipPlace>(R"("kind":"tip","xyz_mm":[1,2,3],"mm":0.5)"),
            (TipPlace{{1'000, 2'000, 3'000}, 500}));
  only_body<NoStall>(R"("kind":"no_stall")");
  only_body<NoWarnings>(R"("kind":"no_warnings")");
  only_body<NoSoftHome>(R"("kind":"no_soft_home")");
  EXPECT_EQ(only_body<Untouched>(R"("kind":"untouched","names":["red","blue"],"mm":2)"),
            (Untouched{{"red", "blue"}, 2'000}));
  EXPECT_EQ(only_body<KeepOut>(R"("kind":"keep_out","box_mm":[[0,0,0],[10,10,10]])").box.high.x,
            10'000);
  EXPECT_EQ(only_body<Order>(R"("kind":"order","events":["grasped red"])").events.size(), 1U);
  EXPECT_EQ(only_body<MaxSimTime>(R"("kind":"max_sim_seconds","value":1.5)").ticks, 1500);
  EXPECT_EQ(only_body<MaxBytes>(R"("kind":"max_bytes","value":90)").bytes, 90U);
  EXPECT_EQ(only_body<MaxTipPath>(R"("kind":"max_tip_path","mm":1200)").length_um, 1'200'000);
}

TEST(GoalsFile, SaysWhatIsWrongWithAGoal) {
  EXPECT_EQ(goal_findings(R"("name":"red")"),
            "/goals/0/kind:  / \"block\", \"stacked\", \"sorted\", \"holding\", \"joint\", "
            "\"tip\", \"no_stall\", \"no_warnings\", \"no_soft_home\", \"untouched\", "
            "\"keep_out\", \"order\", "
            "\"max_sim_seconds\", \"max_bytes\" or \"max_tip_path\"\n");
  EXPECT_PRED2(starts_with, goal_findings(R"("kind":"blok","name":"red")"),
               "/goals/0/kind: \"blok\" / ");
  EXPECT_PRED2(starts_with, goal_findings(R"("kind":"block","name":"rot","xyz_mm":[1,2,3])"),
               "/goals/0/name: \"rot\" / a block of the workcell: ");
  EXPECT_EQ(goal_findings(R"("kind":"block","name":"red")"),
            "/goals/0: no place / one of xyz_mm, box_mm and at, or yaw_deg\n");
  EXPECT_EQ(
      goal_findings(R"("kind":"block","name":"red","xyz_mm":[1,2,3],"box_mm":[[0,0,0],[1,1,1]])"),
      "/goals/0: several places / one of xyz_mm, box_mm and at\n");
  EXPECT_EQ(goal_findings(R"("kind":"block","name":"red","at":"red")"),
            "/goals/0/at: \"red\" / another block\n");
  EXPECT_EQ(goal_findings(R"("kind":"joint","label":"G","value":3)"),
            "/goals/0/label: \"G\" / one of ABCDEF\n");
  EXPECT_EQ(goal_findings(R"("kind":"joint","label":"E")"),
            "/goals/0: neither value nor count / value in degrees or mm, or count\n");
  EXPECT_EQ(goal_findings(R"("kind":"tip","xyz_mm":[null,null,null])"),
            "/goals/0/xyz_mm: no coordinate / at least one number\n");
  EXPECT_PRED2(starts_with, goal_findings(R"("kind":"order","events":["red"])"),
               "/goals/0/events/0: \"red\" / \"grasped NAME\" or \"released NAME\"");
  EXPECT_PRED2(starts_with, goal_findings(R"("kind":"no_stall","speed":1)"), "/goals/0/speed: ");
  EXPECT_NE(goal_findings(R"("kind":"max_bytes","value":-1)"), "");
}

TEST(GoalsFile, AnotherFileIsRefusedInOneSentence) {
  const FileReading<GoalList> reading =
      read_goals(R"({"blocks":[],"workspace":[1,2,3]})", "w.json", nullptr);
  ASSERT_EQ(reading.findings.size(), 1U);
  EXPECT_EQ(reading.findings[0].allowed, "a goals file, with \"goals\"");
  EXPECT_EQ(read_goals("{", "w.json").findings.size(), 1U);
}

TEST(GoalsFile, HasASummary) {
  const GoalList list =
      load_goals(R"({"notes":"Pick it.","goals":[{"kind":"no_stall","points":2},{"kind":"holding",)"
                 R"("name":null}]})",
                 "goals.json", rhino_of_goals());
  EXPECT_EQ(goals_summary(list), "2 goals, 3 points\nPick it.\n  no_stall\n  holding\n");
}

}  // namespace
}  // namespace xr3
