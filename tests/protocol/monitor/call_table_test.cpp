// Every call with valid and invalid args: the resulting values, and all errors at once.
#include "protocol/monitor/call_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/files/workcell.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "tests/protocol/monitor/requests.hpp"
#include "tests/support/models.hpp"

namespace xr3::monitor {
namespace {

/// The value of a valid call that is not a call of the cell.
template <class Call>
Call other_of(const std::string& fn, const std::string& args) {
  const Request request = good(call_text(fn, args));
  return std::get<Call>(std::get<CallRequest>(request.what).call);
}

RequestError refused(const std::string& fn, const std::string& args) {
  return bad(call_text(fn, args));
}

TEST(MonitorCalls, AcceptsCallsWithoutArgs) {
  for (const std::string fn : {"pause", "resume", "reset", "home"}) {
    const std::string start = R"({"op":"call","fn":")" + fn + "\"";
    EXPECT_EQ(std::get<CallRequest>(good(start + "}").what).fn, fn);
    good(start + R"(,"args":{}})");
    EXPECT_EQ(wrong_in(fn, R"({"ticks":1})"), Pointers{"/args/ticks"});
    EXPECT_EQ(wrong_in(fn, "7"), Pointers{"/args"});
  }
}

TEST(MonitorCalls, ParsesARateInMillionths) {
  const auto millionths = [](const std::string& factor) {
    return call_of<call::SetRate>("rate", R"({"factor":)" + factor + "}").rate.millionths;
  };
  EXPECT_EQ(millionths("1"), 1'000'000);
  EXPECT_EQ(millionths("0.1"), 100'000);
  EXPECT_EQ(millionths("0.001"), 1'000);
  EXPECT_EQ(millionths("100000"), 100'000'000'000);
  EXPECT_EQ(millionths("1e5"), 100'000'000'000);
  EXPECT_EQ(millionths("1.000001"), 1'000'001);
  for (const char* factor : {"0", "0.0009", "100000.1", "-1", "\"1\"", "null", "1e300"}) {
    EXPECT_EQ(wrong_in("rate", std::string(R"({"factor":)") + factor + "}"),
              Pointers{"/args/factor"})
        << factor;
  }
  EXPECT_EQ(wrong_in("rate", "{}"), Pointers{"/args/factor"});
}

TEST(MonitorCalls, ParsesTheTicksOfAStep) {
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":200})").ticks, 200);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":0})").ticks, 0);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":2e2})").ticks, 200);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":9007199254740991})").ticks, kMaxInteger);
  for (const char* ticks :
       {"-1", "1.5", "9007199254740992", "18446744073709551615", "1e19", "\"5\"", "null", "[5]"}) {
    EXPECT_EQ(wrong_in("step", std::string(R"({"ticks":)") + ticks + "}"), Pointers{"/args/ticks"})
        << ticks;
  }
  EXPECT_EQ(wrong_in("step", "{}"), Pointers{"/args/ticks"});
}

TEST(MonitorCalls, ParsesTheBarrierOfAStep) {
  const Request request =
      good(R"({"op":"call","id":8,"fn":"step","args":{"ticks":50,"after":{"line":3,"bytes_in":120,)"
           R"("within_ms":2000},"fields":["joints"]}})");
  const auto& wanted = std::get<CallRequest>(request.what);
  ASSERT_TRUE(wanted.after);
  EXPECT_EQ(wanted.after->line, 3U);
  EXPECT_EQ(wanted.after->bytes_in, 120U);
  EXPECT_EQ(wanted.after->within_ms, 2000);
  EXPECT_EQ(wanted.fields, (Fields{{"joints"}}));
}

TEST(MonitorCalls, ABarrierWaitsOneSecondByDefault) {
  const Request request =
      good(R"({"op":"call","fn":"step","args":{"ticks":5,"after":{"line":1,"bytes_in":0}}})");
  EXPECT_EQ(std::get<CallRequest>(request.what).after->within_ms, 1000);
}

TEST(MonitorCalls, ParsesRunUntil) {
  const auto idle = call_of<call::RunUntil>("run_until", R"({"idle":true,"max_ticks":60000})");
  EXPECT_EQ(idle.tick, std::nullopt);
  EXPECT_EQ(idle.max_ticks, 60'000);
  EXPECT_EQ(call_of<call::RunUntil>("run_until", R"({"tick":1000,"max_ticks":5})").tick, 1000);
  EXPECT_EQ(wrong_in("run_until", R"({"max_ticks":5})"), Pointers{"/args/idle"});
  EXPECT_EQ(wrong_in("run_until", R"({"idle":false,"max_ticks":5})"), Pointers{"/args/idle"});
  EXPECT_EQ(wrong_in("run_until", R"({"idle":true,"tick":5,"max_ticks":5})"),
            Pointers{"/args/idle"});
  EXPECT_EQ(wrong_in("run_until", R"({"tick":-5})"), (Pointers{"/args/tick", "/args/max_ticks"}));
}

TEST(MonitorCalls, SendAcceptsTextOrBytes) {
  EXPECT_EQ(other_of<Send>("send", R"({"text":"E?"})").bytes, "E?");
  EXPECT_EQ(other_of<Send>("send", R"({"text":"E+5\rå\u0000"})").bytes,
            std::string("E+5\r\xc3\xa5\0", 7));
  EXPECT_EQ(other_of<Send>("send", R"({"hex":"452b350dFFfe00"})").bytes,
            std::string("E+5\r\xff\xfe\0", 7));
  EXPECT_EQ(other_of<Send>("send", R"({"hex":""})").bytes, "");
  for (const char* args :
       {"{}", R"({"text":"E?","hex":"45"})", R"({"text":5})", R"({"text":null})"})
    EXPECT_EQ(wrong_in("send", args), Pointers{"/args/text"}) << args;
  for (const char* hex : {R"("4")", R"("4g")", R"("0x45")", R"("45 ")", "45", R"(["45"])"}) {
    EXPECT_EQ(wrong_in("send", std::string(R"({"hex":)") + hex + "}"), Pointers{"/args/hex"})
        << hex;
  }
}

TEST(MonitorCalls, SendHasAMaximumLength) {
  const auto text = [](std::size_t bytes) {
    return R"({"text":")" + std::string(bytes, 'x') + "\"}";
  };
  const auto hex = [](std::size_t bytes) {
    return R"({"hex":")" + std::string(2 * bytes, '0') + "\"}";
  };
  EXPECT_EQ(other_of<Send>("send", text(4096)).bytes.size(), 4096U);
  EXPECT_EQ(other_of<Send>("send", hex(4096)).bytes.size(), 4096U);
  EXPECT_EQ(wrong_in("send", text(4097)), Pointers{"/args/text"});
  EXPECT_EQ(wrong_in("send", hex(4097)), Pointers{"/args/hex"});
}

TEST(MonitorCalls, LengthsAreInBytes) {
  const auto umlauts = [](const std::string& member, int letters) {
    std::string text = "{\"" + member + "\":\"";
    for (int i = 0; i < letters; ++i) text += "\xC3\xA4";
    return text + "\"}";
  };
  struct Case {
    const char* fn;
    std::string args;
    Json found;
    const char* allowed;
  };
  const Case cases[] = {
      {"send", R"({"text":")" + std::string(4097, 'x') + "\"}", "string of 4097 bytes",
       "text of 0 to 4096 bytes in UTF-8"},
      {"send", umlauts("text", 3000), "string of 6000 bytes", "text of 0 to 4096 bytes in UTF-8"},
      {"send", R"({"hex":")" + std::string(8194, '0') + "\"}", "string of 8194 bytes",
       "two hexadecimal digits a byte, at most 4096 bytes"},
      {"block_remove", umlauts("name", 21), Json::parse(umlauts("n", 21))["n"],
       "text of 1 to 40 bytes in UTF-8"},
      {"snapshot_save", umlauts("name", 33), Json::parse(umlauts("n", 33))["n"],
       "text of 1 to 64 bytes in UTF-8"},
  };
  for (const Case& c : cases) {
    const RequestError error = bad(call_text(c.fn, c.args));
    ASSERT_EQ(error.details.size(), 1U) << words_of(error);
    EXPECT_EQ(error.details[0].found, c.found);
    EXPECT_EQ(error.details[0].allowed, c.allowed);
  }
  EXPECT_EQ(call_of<call::RemoveBlock>("block_remove", umlauts("name", 20)).name.size(), 40U);
}

TEST(MonitorCalls, ParsesInput) {
  const auto input = call_of<call::SetInput>("input", R"({"input":8,"value":true})");
  EXPECT_EQ(input.input, 8);
  EXPECT_TRUE(input.value);
  EXPECT_EQ(wrong_in("input", "{}"), (Pointers{"/args/input", "/args/value"}));
  EXPECT_EQ(wrong_in("input", R"({"input":0,"value":1})"),
            (Pointers{"/args/input", "/args/value"}));
  EXPECT_EQ(wrong_in("input", R"({"input":9,"value":false,"line":1})"),
            (Pointers{"/args/input", "/args/line"}));
}

TEST(MonitorCalls, ParsesInverse) {
  const auto find = other_of<FindCounts>(
      "inverse", R"({"xyz_mm":[262,0.5,-3],"pitch_deg":-90,"branch":"x","near":{"E":242,"A":-1}})");
  EXPECT_EQ(find.tip_um, (PointUm{262'000, 500, -3'000}));
  EXPECT_EQ(find.pitch_deg, -90);
  EXPECT_EQ(find.roll_deg, std::nullopt);
  EXPECT_EQ(find.branch, "x");
  EXPECT_EQ(find.near, (std::map<char, Counts>{{'A', -1}, {'E', 242}}));
  EXPECT_EQ(wrong_in("inverse", R"({"pitch_deg":"down","near":{"E":1.5,"Z":0}})"),
            (Pointers{"/args/xyz_mm", "/args/pitch_deg", "/args/near/E", "/args/near/Z"}));
}

TEST(MonitorCalls, ParsesLinesAndLineDisconnect) {
  other_of<ListLines>("lines", "{}");
  EXPECT_EQ(other_of<DisconnectLine>("line_disconnect", R"({"line":3})").line, 3U);
  for (const char* line : {"0", "-1", "4294967296", "\"3\"", "null"}) {
    EXPECT_EQ(wrong_in("line_disconnect", std::string(R"({"line":)") + line + "}"),
              Pointers{"/args/line"});
  }
}

TEST(MonitorCalls, ParsesFaults) {
  const auto set = call_of<call::SetFault>(
      "fault_set",
      R"({"fault":{"name":"jam","kind":"motor_slow","joint":"E","percent":5,"at_tick":9},)"
      R"("seed":4})");
  EXPECT_EQ(set.fault.name, "jam");
  EXPECT_EQ(set.fault.percent, 5U);
  EXPECT_EQ(set.seed, 4U);
  EXPECT_EQ(wrong_in("fault_set", "{}"), Pointers{"/args/fault"});
  EXPECT_EQ(
      wrong_in("fault_set", R"({"fault":{"name":"","kind":"motor_slow","at_tick":-1},"seed":-1})"),
      (Pointers{"/args/seed", "/name", "/at_tick"}));
  EXPECT_EQ(wrong_in("fault_set", R"({"fault":{"name":"x","kind":"motor_stuck","at_tick":1}})"),
            Pointers{"/joint"});
  other_of<ListFaults>("fault_list", "{}");
  other_of<ReadTranscript>("transcript", "{}");
  other_of<ReadHistory>("history", "{}");
  other_of<Live>("live", "{}");
  EXPECT_EQ(other_of<Look>("look", R"({"tick":5})").selections.size(), 1U);
  const Look look = other_of<Look>(
      "look", R"({"tick":5,"epoch":2,"channels":["image","state"],"encoding":"rle"})");
  EXPECT_EQ(look.at.tick, 5);
  EXPECT_EQ(look.at.epoch, 2);
  ASSERT_EQ(look.selections.size(), 2U);
  EXPECT_EQ(look.selections[0].channel, Channel::kState);
  EXPECT_EQ(look.selections[1].encoding, Encoding::kRle);
  const Look twice = other_of<Look>("look", R"({"tick":5,"channels":["image","image"]})");
  EXPECT_EQ(twice.selections.size(), 1U) << "an image is sent once";
  const Trace trace = other_of<Trace>("trace", R"({"tick":5,"epoch":2,"every":20})");
  EXPECT_EQ(trace.from.tick, 5);
  EXPECT_EQ(trace.from.epoch, 2);
  EXPECT_EQ(trace.every, 20);
  EXPECT_EQ(other_of<Trace>("trace", R"({"tick":5})").every, 100);
  EXPECT_EQ(wrong_in("trace", R"({"every":9})"), (Pointers{"/args/tick", "/args/every"}));
  EXPECT_EQ(other_of<Seek>("seek", R"({"tick":7})").at.tick, 7);
  EXPECT_EQ(other_of<Seek>("seek", R"({"tick":7})").at.epoch, std::nullopt);
  EXPECT_EQ(other_of<Branch>("branch", R"({"tick":7,"epoch":1})").at.epoch, 1);
  EXPECT_EQ(call_of<call::ClearFault>("fault_clear", R"({"name":"jam"})").name, "jam");
  EXPECT_EQ(call_of<call::ClearFault>("fault_clear", "{}").name, "");
  EXPECT_EQ(wrong_in("fault_clear", R"({"name":""})"), Pointers{"/args/name"});
}

TEST(MonitorCalls, AcceptsKeysOfCommandMode) {
  const auto command = [](const std::string& args) {
    return call_of<call::Key>("key", args).command;
  };
  EXPECT_EQ(command(R"({"function":"display"})"), Command{ToggleDisplay{}});
  EXPECT_EQ(command(R"({"function":"view","value":[1,-9,0]})"), (Command{SetViewVector{1, -9, 0}}));
  EXPECT_EQ(command(R"({"function":"home"})"), Command{SoftHome{}});
  EXPECT_EQ(command(R"({"function":"status","value":6})"), Command{SelectStatus{6}});
  EXPECT_EQ(command(R"({"function":"enabled"})"), Command{ToggleSimulator{}});
  EXPECT_EQ(command(R"({"function":"function_keys"})"), Command{ToggleFunctionKeys{}});
  EXPECT_EQ(command(R"({"function":"period","value":255})"), Command{SetRefreshPeriod{255}});
  EXPECT_EQ(command(R"({"function":"path"})"), Command{ToggleErasing{}});
}

TEST(MonitorCalls, RejectsInvalidKeys) {
  struct Row {
    const char* args;
    Pointers pointers;
  };
  const Row rows[] = {
      {"{}", {"/args/function"}},
      {R"({"function":"Display"})", {"/args/function"}},
      {R"({"function":"dance","value":1,"more":2})", {"/args/function", "/args/more"}},
      {R"({"function":"display","value":true})", {"/args/value"}},
      {R"({"function":"home","value":null})", {"/args/value"}},
      {R"({"function":"view"})", {"/args/value"}},
      {R"({"function":"view","value":[0,0,0]})", {"/args/value"}},
      {R"({"function":"view","value":[1,2]})", {"/args/value"}},
      {R"({"function":"view","value":[10,0.5,0]})", {"/args/value/0", "/args/value/1"}},
      {R"({"function":"status","value":7})", {"/args/value"}},
      {R"({"function":"status"})", {"/args/value"}},
      {R"({"function":"period","value":0})", {"/args/value"}},
  };
  for (const Row& row : rows) EXPECT_EQ(wrong_in("key", row.args), row.pointers) << row.args;
}

TEST(MonitorCalls, ParsesBlockAdd) {
  const Block block =
      call_of<call::AddBlock>(
          "block_add",
          R"({"name":"green","size_mm":[40,20.5,10],"xyz_mm":[300,-0.001,20],"yaw_deg":-270,)"
          R"("color":2})")
          .block;
  EXPECT_EQ(block,
            (Block{"green", {40'000, 20'500, 10'000}, {300'000, -1, 20'000}, 90'000'000, 2}));
  EXPECT_EQ(call_of<call::AddBlock>("block_add",
                                    R"({"name":"g","size_mm":[1,1,1],"xyz_mm":[0,0,0],"color":15})")
                .block.yaw_udeg,
            0);
}

TEST(MonitorCalls, RejectsInvalidBlocks) {
  EXPECT_EQ(wrong_in("block_add", "{}"),
            (Pointers{"/args/name", "/args/size_mm", "/args/xyz_mm", "/args/color"}));
  const RequestError error = refused(
      "block_add",
      R"({"name":"","size_mm":[0,-5,"1"],"xyz_mm":[1,2],"yaw_deg":361,"color":16,"size":[1,1,1]})");
  EXPECT_EQ(pointers_of(error),
            (Pointers{"/args/name", "/args/size_mm/0", "/args/size_mm/1", "/args/size_mm/2",
                      "/args/xyz_mm", "/args/yaw_deg", "/args/color", "/args/size"}));
  EXPECT_EQ(error.details[2].found, -5);
  EXPECT_EQ(error.details[3].found, "1");
  EXPECT_EQ(error.details[2].allowed, "a length above 0, up to 100000 mm");
  EXPECT_EQ(error.details[4].found, (Json{1, 2}));
  EXPECT_EQ(error.details[4].allowed,
            "a list [x, y, z] of three lengths, each from -100000 to 100000 mm");
}

TEST(MonitorCalls, ParsesBlockMove) {
  const auto both =
      call_of<call::MoveBlock>("block_move", R"({"name":"red","xyz_mm":[1,2,3],"yaw_deg":90})");
  EXPECT_EQ(both.name, "red");
  EXPECT_EQ(both.centroid_um, (PointUm{1000, 2000, 3000}));
  EXPECT_EQ(both.yaw_udeg, 90'000'000);
  const auto turned = call_of<call::MoveBlock>("block_move", R"({"name":"red","yaw_deg":0})");
  EXPECT_EQ(turned.centroid_um, std::nullopt);
  EXPECT_EQ(turned.yaw_udeg, 0);
  EXPECT_EQ(wrong_in("block_move", R"({"name":"red"})"), Pointers{"/args/xyz_mm"});
  EXPECT_EQ(wrong_in("block_move", R"({"xyz_mm":[1,2,null]})"),
            (Pointers{"/args/name", "/args/xyz_mm/2"}));
}

TEST(MonitorCalls, ParsesBlockRemove) {
  EXPECT_EQ(call_of<call::RemoveBlock>("block_remove", R"({"name":"red"})").name, "red");
  EXPECT_EQ(wrong_in("block_remove", R"({"name":7})"), Pointers{"/args/name"});
}

std::string workcell_text(std::string_view name) {
  return workcell_to_json(test::workcell_named(name)).dump();
}

TEST(MonitorCalls, ParsesWorkcell) {
  const auto replaced = call_of<call::ReplaceWorkcell>(
      "workcell", R"({"workcell":)" + workcell_text("rhino-xr3") + "}");
  EXPECT_EQ(replaced.workcell, test::workcell_named("rhino-xr3"));
  Json large = Json::parse(workcell_text("rhino-xr3"));
  large["camera"]["pixels"] = {kMaxFilePixels, kMaxFilePixels + 1};
  EXPECT_EQ(wrong_in("workcell", R"({"workcell":)" + large.dump() + "}"),
            Pointers{"/camera/pixels/1"});
  EXPECT_EQ(wrong_in("workcell", "{}"), Pointers{"/args/workcell"});
  EXPECT_EQ(wrong_in("workcell", R"({"workcell":[]})"), Pointers{"/args/workcell"});
}

TEST(MonitorCalls, ErrorsOfAWorkcellPointIntoIt) {
  Json workcell = Json::parse(workcell_text("rhino-xr3"));
  workcell["blocks"][1]["size"][0] = -5;
  workcell["blocks"][2]["name"] = workcell["blocks"][0]["name"];
  workcell["camera"]["pixels"][0] = "64";
  workcell.erase("workspace");
  workcell["colour"] = 1;
  const RequestError error = refused("workcell", R"({"workcell":)" + workcell.dump() + "}");
  Pointers pointers = pointers_of(error);
  std::sort(pointers.begin(), pointers.end());
  EXPECT_EQ(pointers, (Pointers{"/blocks/1/size/0", "/blocks/2/name", "/camera/pixels/0", "/colour",
                                "/workspace"}));
  for (const Detail& detail : error.details) {
    if (detail.pointer == "/blocks/1/size/0") EXPECT_EQ(detail.found, -5);
    if (detail.pointer == "/camera/pixels/0") EXPECT_EQ(detail.found, "64");
    if (detail.pointer == "/workspace") EXPECT_EQ(detail.found, nullptr);
  }
}

TEST(MonitorCalls, WarningsOfAWorkcellAreNotErrors) {
  Json workcell = Json::parse(workcell_text("rhino-xr3"));
  workcell["blocks"][0]["centroid"] = {9000, 9000, 9000};
  good(call_text("workcell", R"({"workcell":)" + workcell.dump() + "}"));
}

TEST(MonitorCalls, RejectsAWorkcellWithTooManyMembersUnread) {
  std::string members = "\"x\":0";
  for (int i = 0; i < 64; ++i) members += ",\"x" + std::to_string(i) + "\":0";
  const std::string nested = R"({"workcell":{"blocks":[{)" + members + "}]}}";
  EXPECT_EQ(wrong_in("workcell", nested), Pointers{"/args/workcell"});
  EXPECT_EQ(wrong_in("snapshot_load", R"({"snapshot":{)" + members + "}}"),
            Pointers{"/args/snapshot"});
}

TEST(MonitorCalls, ParsesSnapshotSave) {
  EXPECT_EQ(call_of<call::SaveSnapshot>("snapshot_save", R"({"name":"before-pick"})").name,
            "before-pick");
  EXPECT_EQ(call_of<call::SaveSnapshot>("snapshot_save", R"({"inline":true})").name, "");
  good(call_text("snapshot_save", R"({"name":")" + std::string(64, 'x') + "\"}"));
  for (const std::string& args :
       {std::string("{}"), std::string(R"({"name":""})"), std::string(R"({"name":5})"),
        R"({"name":")" + std::string(65, 'x') + "\"}",
        std::string(R"({"name":"a","inline":true})")}) {
    EXPECT_EQ(wrong_in("snapshot_save", args), Pointers{"/args/name"}) << args;
  }
  EXPECT_EQ(wrong_in("snapshot_save", R"({"inline":false})"), Pointers{"/args/inline"});
}

TEST(MonitorCalls, ParsesSnapshotLoadByName) {
  const auto named = call_of<call::LoadSnapshot>("snapshot_load", R"({"name":"before-pick"})");
  EXPECT_EQ(named.name, "before-pick");
  EXPECT_EQ(named.saved, nullptr);
  for (const char* args : {"{}", R"({"name":""})", R"({"name":"a","snapshot":{}})"})
    EXPECT_EQ(wrong_in("snapshot_load", args), Pointers{"/args/name"}) << args;
  EXPECT_EQ(wrong_in("snapshot_load", R"({"snapshot":5})"), Pointers{"/args/snapshot"});
}

TEST(MonitorCalls, ParsesAnInlineSnapshot) {
  SavedCell saved{"sha256:1", test::workcell_named("rhino-xr3"), State{}};
  saved.state.blocks = saved.workcell.blocks;
  const std::string text = saved_cell_to_json(saved).dump();
  const auto loaded = call_of<call::LoadSnapshot>("snapshot_load", R"({"snapshot":)" + text + "}");
  ASSERT_NE(loaded.saved, nullptr);
  EXPECT_EQ(*loaded.saved, saved);
  EXPECT_EQ(wrong_in("snapshot_load", R"({"snapshot":{}})"),
            (Pointers{"/robot_hash", "/workcell", "/state"}));
}

TEST(MonitorCalls, DescribesEveryCall) {
  const Json all = description(other_of<Describe>("describe", "{}").fn)["calls"];
  ASSERT_EQ(all.size(), calls().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i]["fn"], calls()[i]);
    EXPECT_TRUE(all[i]["purpose"].get<std::string>().ends_with("."));
    for (const Json& arg : all[i]["args"]) EXPECT_NE(arg["allowed"], "") << all[i]["fn"];
  }
}

TEST(MonitorCalls, DescribesOneCall) {
  const Json step = description(other_of<Describe>("describe", R"({"fn":"step"})").fn)["calls"];
  ASSERT_EQ(step.size(), 1U);
  EXPECT_EQ(step[0]["fn"], "step");
  const Json& args = step[0]["args"];
  ASSERT_EQ(args.size(), 3U);
  EXPECT_EQ(args[0], (Json{{"name", "ticks"},
                           {"required", true},
                           {"allowed", "a whole number 0...9007199254740991"}}));
  EXPECT_EQ(args[1]["name"], "after");
  EXPECT_EQ(args[1]["required"], false);
  EXPECT_EQ(args[2]["name"], "fields");
  EXPECT_EQ(wrong_in("describe", R"({"fn":"fly"})"), Pointers{"/args/fn"});
  EXPECT_EQ(wrong_in("describe", R"({"fn":null})"), Pointers{"/args/fn"});
}

/// Descriptions are complete: no other argument is accepted, and every required one is missed.
TEST(MonitorCalls, DescriptionsMatchTheParser) {
  const Json all = description(std::nullopt);
  for (const Json& call : all["calls"]) {
    const std::string fn = call["fn"];
    const RequestError error = bad(call_text(fn, R"({"surely":"unknown"})"));
    EXPECT_EQ(error.details.back().pointer, "/args/surely") << fn;
    for (const Json& arg : call["args"]) {
      const auto pointers = pointers_of(error);
      const std::string pointer = "/args/" + arg["name"].get<std::string>();
      const bool is_missed = std::find(pointers.begin(), pointers.end(), pointer) != pointers.end();
      if (arg["required"] == true) EXPECT_TRUE(is_missed) << fn << pointer;
    }
  }
}

}  // namespace
}  // namespace xr3::monitor
