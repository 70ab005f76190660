#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "core/home.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/document.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/recording/entry_json.hpp"
#include "tests/support/models.hpp"

namespace xr3::recording {
namespace {

Workcell full_workcell() { return test::workcell_named("rhino-xr3"); }

SavedCellPtr some_saved_cell() {
  const Model model(test::robot_named("rhino-xr3"), full_workcell(), Profile::kPaper);
  State state = initial_state(model);
  state.tick = 77;
  state.motors[1].count = -5;
  return std::make_shared<const SavedCell>(SavedCell{"sha256:abc", full_workcell(), state});
}

Fault some_fault() {
  Fault fault;
  fault.name = "noise";
  fault.kind = FaultKind::kByteFlipped;
  fault.line = 3;
  fault.direction = LineSide::kOut;
  fault.bit = 4;
  fault.chance = 333'333'333;
  return fault;
}

/// Adds the kinds that are not among the calls, as they are by default.
template <std::size_t... kinds>
void add_other_kinds(std::vector<call::Call>& calls, std::index_sequence<kinds...>) {
  const auto is_missing = [&](std::size_t kind) {
    return std::none_of(calls.begin(), calls.end(),
                        [&](const call::Call& each) { return each.index() == kind; });
  };
  ((is_missing(kinds) ? void(calls.emplace_back(std::in_place_index<kinds>)) : void()), ...);
}

/// At least one call of each kind, with unusual arguments if it has any.
std::vector<call::Call> all_calls() {
  using namespace call;  // NOLINT: the calls
  std::vector<Call> calls = {
      Pause{},
      Resume{},
      SetRate{{1'234'567}},
      SetRate{kSlowest},
      SetRate{kFastest},
      SetRate{{99'999'999'999}},
      Step{0},
      Step{9'007'199'254'740'991},
      RunUntil{std::nullopt, 5},
      RunUntil{123'456'789, 7},
      Reset{},
      Home{},
      SetInput{8, true},
      SetInput{1, false},
      SayNotice{"Save your \"work\"\n\xc3\xa9"},
      AddBlock{{"a \"block\"", {12'345, 1, 999'999}, {-1, 2, 33'333}, 89'999'999, 3}},
      MoveBlock{"x", PointUm{1, -2, 3}, std::nullopt},
      MoveBlock{"x", std::nullopt, -179'999'999},
      MoveBlock{"x", PointUm{7, 8, 9}, 180'000'000},
      RemoveBlock{"\xc3\xa9t\xc3\xa9"},
      ReplaceWorkcell{full_workcell()},
      SaveSnapshot{""},
      SaveSnapshot{"half way"},
      LoadSnapshot{"half way", nullptr},
      LoadSnapshot{"", some_saved_cell()},
      SetFault{some_fault(), std::nullopt},
      SetFault{some_fault(), 9'007'199'254'740'991},
      ClearFault{""},
      ClearFault{"noise"}};
  for (const Command& command :
       {Command(ToggleDisplay{}), Command(SetViewVector{-9, 0, 9}), Command(SoftHome{}),
        Command(SelectStatus{6}), Command(ToggleSimulator{}), Command(ToggleFunctionKeys{}),
        Command(SetRefreshPeriod{255}), Command(ToggleErasing{})})
    calls.emplace_back(Key{command});
  add_other_kinds(calls, std::make_index_sequence<std::variant_size_v<Call>>());
  return calls;
}

/// Reads an entry with `{"call":fn,"args":args}`; the findings go to `findings`.
std::optional<call::Call> read_back(const std::string& text, Findings* findings = nullptr) {
  const std::string entry_text = R"({"tick":0,)" + text.substr(1);
  const JsonDocument document(entry_text);
  data::Reading reading(document.root(), data::Unit::kMm);
  const auto entry = read_entry(reading, 0);
  if (findings != nullptr) *findings = reading.take_findings();
  return entry ? std::optional(std::get<CallMade>(entry->body).call) : std::nullopt;
}

std::string text_of_call(const call::Call& call) {
  const monitor::WrittenCall json = monitor::written(call);
  return Json{{"call", json.fn}, {"args", json.args}}.dump(-1, ' ', true);
}

TEST(RecordedCall, EveryKindSurvivesTheRoundTrip) {
  std::set<std::size_t> kinds;
  for (const call::Call& call : all_calls()) {
    const std::string text = text_of_call(call);
    const auto read = read_back(text);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(read->index(), call.index()) << text;
    EXPECT_EQ(text_of_call(*read), text);
    kinds.insert(call.index());
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<call::Call>);
}

TEST(RecordedCall, ValuesAreExact) {
  const auto back = [](const call::Call& call) { return *read_back(text_of_call(call)); };
  for (const std::int64_t rate : {1'000, 1'001, 3'333'333}) {
    const auto read = back(call::SetRate{{rate}});
    EXPECT_EQ(std::get<call::SetRate>(read).rate.millionths, rate);
  }
  const auto load = back(call::LoadSnapshot{"", some_saved_cell()});
  EXPECT_EQ(*std::get<call::LoadSnapshot>(load).saved, *some_saved_cell());
  const auto fault = back(call::SetFault{some_fault(), {}});
  EXPECT_EQ(std::get<call::SetFault>(fault).fault, some_fault());
  const auto workcell = back(call::ReplaceWorkcell{full_workcell()});
  EXPECT_EQ(std::get<call::ReplaceWorkcell>(workcell).workcell, full_workcell());
  for (const Microdegrees yaw : {1, -1, 123'456'789, 179'999'999}) {
    const auto move = back(call::MoveBlock{"x", PointUm{yaw / 10, 5, -yaw / 7}, yaw});
    EXPECT_EQ(std::get<call::MoveBlock>(move).yaw_udeg, yaw);
    EXPECT_EQ(std::get<call::MoveBlock>(move).centroid_um, (PointUm{yaw / 10, 5, -yaw / 7}));
  }
}

TEST(RecordedCall, WorkcellsOfEarlierVersionsMayBeLarger) {
  Workcell large = full_workcell();
  large.camera->pixels_x = kMaxSavedPixels;
  for (std::size_t i = large.blocks.size(); i <= kMaxFileBlocks; ++i) {
    large.blocks.edit().push_back(large.blocks[0]);
    large.blocks.edit().back().name = std::to_string(i);
  }
  const auto read = read_back(text_of_call(call::ReplaceWorkcell{large}));
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<call::ReplaceWorkcell>(*read).workcell, large);
}

TEST(RecordedCall, OtherCallsAndWrongArgumentsAreRefused) {
  Findings findings;
  for (const char* text :
       {R"({"call":"send","args":{"text":"E?"}})", R"({"call":"lines","args":{}})",
        R"({"call":"nothing","args":{}})", R"({"call":"step"})", R"({"call":7,"args":{}})",
        R"({"call":"step","args":{"ticks":-1}})", R"({"call":"step","args":{"ticks":1,"more":2}})",
        R"({"call":"step","args":{}})"}) {
    EXPECT_FALSE(read_back(text, &findings)) << text;
    EXPECT_FALSE(findings.empty()) << text;
  }
  read_back(R"({"call":"step","args":{"ticks":-1}})", &findings);
  EXPECT_EQ(findings.front().pointer, "/args/ticks");
}

}  // namespace
}  // namespace xr3::recording
