// Every request, and every error code for invalid ones.
#include "protocol/monitor/request.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/monitor/fields.hpp"
#include "protocol/monitor/request_error.hpp"
#include "tests/protocol/monitor/requests.hpp"

namespace xr3::monitor {
namespace {

TEST(MonitorRequest, AcceptsPingWithEveryKindOfId) {
  EXPECT_EQ(good(R"({"op":"ping"})").id, RequestId{});
  EXPECT_EQ(good(R"({"op":"ping","id":null})").id, RequestId{});
  EXPECT_EQ(good(R"({"op":"ping","id":16})").id, RequestId{std::int64_t{16}});
  EXPECT_EQ(good(R"({"op":"ping","id":-9007199254740991})").id, RequestId{-kMaxInteger});
  EXPECT_EQ(good(R"({"op":"ping","id":"a"})").id, RequestId{std::string("a")});
  EXPECT_EQ(good(R"({"op":"ping","id":")" + std::string(64, 'x') + R"("})").id,
            RequestId{std::string(64, 'x')});
}

TEST(MonitorRequest, RejectsInvalidIds) {
  const std::string too_long = "\"" + std::string(65, 'x') + "\"";
  for (const std::string& id :
       {std::string("1.5"), std::string("[1]"), std::string("true"),
        std::string("9007199254740992"), std::string("-9007199254740992"),
        std::string("18446744073709551615"), std::string("1e300"), too_long}) {
    const RequestError error = bad(R"({"op":"ping","id":)" + id + "}");
    EXPECT_EQ(error.code, "bad_args") << id;
    EXPECT_EQ(error.id, RequestId{}) << id;
    ASSERT_EQ(error.details.size(), 1U) << id;
    EXPECT_EQ(error.details[0].pointer, "/id");
  }
}

template <class What>
What what_of(const std::string& text) {
  const Request request = good(text);
  return std::get<What>(request.what);
}

Pointers wrong(const std::string& text) {
  const RequestError error = bad(text);
  EXPECT_EQ(error.code, "bad_args") << text;
  return pointers_of(error);
}

TEST(MonitorRequest, ParsesAuth) {
  EXPECT_EQ(what_of<Auth>(R"({"op":"auth","token":"3q2-7w"})").token, "3q2-7w");
  EXPECT_EQ(wrong(R"({"op":"auth"})"), Pointers{"/token"});
  const RequestError error = bad(R"({"op":"auth","token":12345678})");
  ASSERT_EQ(pointers_of(error), Pointers{"/token"});
  EXPECT_EQ(error.details[0].found, nullptr) << "a token is never shown";
}

TEST(MonitorRequest, ParsesSub) {
  const auto plain = what_of<Subscribe>(R"({"op":"sub","channel":"state"})");
  EXPECT_EQ(plain.selection, Selection{});
  EXPECT_EQ(plain.max_millihz, 30'000);
  EXPECT_TRUE(plain.on_change);
  EXPECT_EQ(plain.since, std::nullopt);
  const auto all = what_of<Subscribe>(
      R"({"op":"sub","channel":"image","max_hz":0.1,"on_change":false,"fields":["rows","width"],)"
      R"("encoding":"rle"})");
  EXPECT_EQ(all.selection, (Selection{Channel::kImage, {{"rows", "width"}}, Encoding::kRle}));
  EXPECT_EQ(all.max_millihz, 100);
  EXPECT_FALSE(all.on_change);
}

TEST(MonitorRequest, ParsesRatesOfASubscription) {
  const auto millihz = [](const std::string& max_hz) {
    return what_of<Subscribe>(R"({"op":"sub","channel":"model","max_hz":)" + max_hz + "}")
        .max_millihz;
  };
  EXPECT_EQ(millihz("60"), 60'000);
  EXPECT_EQ(millihz("0.1"), 100);
  EXPECT_EQ(millihz("29.97"), 29'970);
  for (const char* max_hz : {"0", "0.09", "60.1", "-1", "1e300", "\"30\"", "null"}) {
    EXPECT_EQ(wrong(std::string(R"({"op":"sub","channel":"state","max_hz":)") + max_hz + "}"),
              Pointers{"/max_hz"})
        << max_hz;
  }
}

TEST(MonitorRequest, SinceIsOnlyForEventsAndLines) {
  EXPECT_EQ(what_of<Subscribe>(R"({"op":"sub","channel":"event","since":4711})").since, 4711);
  EXPECT_EQ(what_of<Subscribe>(R"({"op":"sub","channel":"line","since":0})").since, 0);
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"line","since":7})").since, 7);
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"event"})").since, std::nullopt);
  EXPECT_EQ(what_of<Subscribe>(R"({"op":"sub","channel":"state","since":"x"})").since,
            std::nullopt);
  for (const char* since : {"-1", "1.5", "9007199254740992", "\"1\"", "null"}) {
    EXPECT_EQ(wrong(std::string(R"({"op":"get","channel":"event","since":)") + since + "}"),
              Pointers{"/since"})
        << since;
  }
}

TEST(MonitorRequest, EncodingIsOnlyForImages) {
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"image"})").selection.encoding, Encoding::kRows);
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"image","encoding":"rle"})").selection.encoding,
            Encoding::kRle);
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"state","encoding":"rle"})").selection.encoding,
            Encoding::kRows);
  const RequestError error = bad(R"({"op":"get","channel":"image","encoding":"png"})");
  ASSERT_EQ(pointers_of(error), Pointers{"/encoding"});
  EXPECT_EQ(error.details[0].found, "png");
  EXPECT_EQ(error.details[0].allowed, R"("rows" or "rle")");
}

TEST(MonitorRequest, ParsesUnsub) {
  EXPECT_EQ(what_of<Unsubscribe>(R"({"op":"unsub","channel":"display"})").channel,
            Channel::kDisplay);
  EXPECT_EQ(bad(R"({"op":"unsub"})").code, "unknown_channel");
}

TEST(MonitorRequest, ParsesGet) {
  const auto get = what_of<Get>(
      R"({"op":"get","id":5,"channel":"state","fields":["stalled","moving","stalled","tick"]})");
  EXPECT_EQ(get.selection.channel, Channel::kState);
  EXPECT_EQ(get.selection.fields, (Fields{{"stalled", "moving", "tick"}}));
  EXPECT_EQ(what_of<Get>(R"({"op":"get","channel":"state"})").selection.fields, std::nullopt);
}

TEST(MonitorRequest, AcceptsOnlyFieldsOfTheChannel) {
  what_of<Get>(R"({"op":"get","channel":"event","fields":["event","message","seq"]})");
  what_of<Get>(R"({"op":"get","channel":"line","fields":["hex","parsed"]})");
  what_of<Get>(R"({"op":"get","channel":"display","fields":["polylines","function_keys"]})");
  what_of<Get>(R"({"op":"get","channel":"model","fields":["hash"]})");
  const RequestError error = bad(R"({"op":"get","channel":"model","fields":["hash","joints",1]})");
  EXPECT_EQ(pointers_of(error), (Pointers{"/fields/1", "/fields/2"}));
  EXPECT_EQ(error.details[0].allowed, R"("rev", "robot", "workcell" or "hash")");
}

TEST(MonitorRequest, ReportsEveryInvalidMemberOfASubscription) {
  EXPECT_EQ(
      wrong(R"({"op":"sub","id":1.5,"channel":"image","fields":"all","encoding":1,"max_hz":99,)"
            R"("on_change":1})"),
      (Pointers{"/id", "/fields", "/encoding", "/max_hz", "/on_change"}));
}

TEST(MonitorRequest, AnErrorListsTheChannels) {
  EXPECT_EQ(channels(), (std::vector<std::string>{"state", "image", "event", "line", "display",
                                                  "model", "overview"}));
}

TEST(MonitorRequest, IgnoresUnknownMembers) {
  good(R"({"op":"ping","why":{"not":[1,2]}})");
  good(R"({"op":"get","channel":"state","encoding":"rle","since":4})");
  good(R"({"op":"call","fn":"home","comment":"hello"})");
}

TEST(MonitorRequest, FindsCellsByName) {
  EXPECT_EQ(good(R"({"op":"ping"})").cell, std::nullopt);
  EXPECT_EQ(good(R"({"op":"ping","cell":"second"})").cell, "second");
  EXPECT_EQ(bad(R"({"op":"ping","cell":1})").code, "unknown_cell");
}

TEST(MonitorRequest, ReportsEveryInvalidField) {
  const RequestError error =
      bad(R"({"op":"call","id":[],"fn":"step","args":{"ticks":-1,"a/b":2,"after":{"line":0,"x":1,)"
          R"("within_ms":60001},"fields":["nope",3]}})");
  EXPECT_EQ(error.message, "9 wrong fields");
  EXPECT_EQ(error.hint, "nothing was changed");
  EXPECT_EQ(pointers_of(error),
            (Pointers{"/id", "/args/ticks", "/args/after/line", "/args/after/bytes_in",
                      "/args/after/within_ms", "/args/after/x", "/args/fields/0", "/args/fields/1",
                      "/args/a~1b"}));
  EXPECT_EQ(error.details[1].found, -1);
  EXPECT_EQ(error.details[1].allowed, "a whole number 0...9007199254740991");
  EXPECT_EQ(error.details[3].found, nullptr);
}

TEST(MonitorRequest, TruncatesLongValuesInErrors) {
  std::string members;
  for (int i = 0; i < 5000; ++i) members += ",\"x" + std::to_string(i) + "\":0";
  const RequestError error = bad(R"({"op":"call","fn":"step","args":{"ticks":")" +
                                 std::string(9999, 'y') + "\"" + members + "}}");
  EXPECT_EQ(error.message, "5001 wrong fields, the first of them in details");
  EXPECT_EQ(error.details.size(), 32U);
  EXPECT_EQ(error.details[0].found, "string of 9999 bytes");
}

TEST(MonitorRequest, ErrorsForUnknownNamesListTheKnownOnes) {
  struct Row {
    const char* text;
    const char* code;
    const char* message;
  };
  const Row rows[] = {
      {R"({"id":1})", "unknown_op", "the request names no op"},
      {R"({"id":1,"op":"seek","channel":"state"})", "unknown_op", R"(there is no op "seek")"},
      {R"({"id":1,"op":["ping"]})", "unknown_op", R"(there is no op ["ping"])"},
      {R"({"id":1,"op":"get"})", "unknown_channel", "the request names no channel"},
      {R"({"id":1,"op":"get","channel":"images"})", "unknown_channel",
       R"(there is no channel "images")"},
      {R"({"id":1,"op":"call"})", "unknown_fn", "the request names no fn"},
      {R"({"id":1,"op":"call","fn":"sendd"})", "unknown_fn", R"(there is no fn "sendd")"},
  };
  for (const Row& row : rows) {
    const RequestError error = bad(row.text);
    EXPECT_EQ(error.code, row.code) << row.text;
    EXPECT_EQ(error.message, row.message);
    EXPECT_EQ(error.id, RequestId{std::int64_t{1}});
    EXPECT_FALSE(error.hint.empty());
  }
  EXPECT_EQ(bad(R"({"op":"seek"})").hint,
            R"(there is "auth", "sub", "unsub", "get", "call" or "ping")");
}

TEST(MonitorRequest, ReportsMalformedJson) {
  const std::string where = "line 1, column ";
  EXPECT_EQ(bad(R"({"op":"ping)").message,
            where + "12: text without its closing quote; allowed: text in double quotes");
  EXPECT_EQ(bad(R"({"op":"ping")").message,
            where + "13: the end of the message; allowed: a comma or }");
  EXPECT_EQ(bad(R"({"op":"ping"} {)").message,
            where + "15: {; allowed: nothing after the end of the value");
  EXPECT_EQ(bad(std::string(R"({"op":"ping"})") + '\0' + "{").message,
            where + "14: a NUL byte; allowed: JSON in UTF-8");
  EXPECT_EQ(bad("{\n\"op\":\n  ping}").message.substr(0, 22), "line 3, column 3: ping");
  EXPECT_EQ(bad("\n\n [1]").message, "line 3, column 2: no object; allowed: {");
  for (const char* text :
       {"{", "{]", "{'op':1}", "{\"a\":\"\xff\"}", "{\"a\":1e999}", "{\"a\":01}",
        "{\"a\":\"\x01\"}", "{\"a\":nul}", "{\"a\":\"\\ud800\"}", "[1]", "7", ""}) {
    const RequestError error = bad(text);
    EXPECT_EQ(error.code, "bad_json") << text;
    EXPECT_EQ(error.id, RequestId{});
    EXPECT_EQ(error.message.rfind(where, 0), 0U) << error.message;
  }
}

TEST(MonitorRequest, LimitsTheDepth) {
  const auto nested = [](int depth) {
    const auto lists = static_cast<std::size_t>(depth - 1);
    return R"({"op":"ping","x":)" + std::string(lists, '[') + std::string(lists, ']') + "}";
  };
  good(nested(32));
  EXPECT_EQ(bad(nested(33)).code, "too_deep");
  EXPECT_EQ(bad(nested(100'000)).code, "too_deep");
  good(R"({"op":"ping","x":")" + std::string(100, '[') + R"(\"[["})");
}

TEST(MonitorRequest, LimitsTheLength) {
  const std::string start = R"({"op":"ping","x":")";
  good(start + std::string(kMaxMessageBytes - start.size() - 2, 'x') + "\"}");
  EXPECT_EQ(bad(start + std::string(kMaxMessageBytes - start.size() - 1, 'x') + "\"}").code,
            "too_long");
}

TEST(MonitorRequest, LimitsTicksToTheLargestInteger) {
  Request step = good(R"({"op":"call","id":3,"fn":"step","args":{"ticks":10}})");
  EXPECT_FALSE(limit_ticks(step, kMaxInteger - 10));
  const auto error = limit_ticks(step, kMaxInteger - 9);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, "bad_args");
  EXPECT_EQ(error->id, RequestId{std::int64_t{3}});

  Request run =
      good(R"({"op":"call","fn":"run_until","args":{"idle":true,"max_ticks":9007199254740991}})");
  EXPECT_FALSE(limit_ticks(run, 1000));
  EXPECT_EQ(std::get<call::RunUntil>(std::get<call::Call>(std::get<CallRequest>(run.what).call))
                .max_ticks,
            kMaxInteger - 1000);
}

// --- Duplicate members.

TEST(MonitorRequest, RejectsADuplicateMember) {
  const RequestError error =
      bad(R"({"op":"call","id":"d","fn":"step","args":{"ticks":1,"ticks":500}})");
  EXPECT_EQ(error.code, "bad_args");
  EXPECT_EQ(error.id, RequestId{std::string("d")});
  ASSERT_EQ(pointers_of(error), Pointers{"/args/ticks"});
  EXPECT_EQ(error.details[0].found, "\"ticks\", a duplicate");
  EXPECT_EQ(error.details[0].allowed, "each member once");
}

TEST(MonitorRequest, RejectsDuplicateMembersAtEveryDepth) {
  EXPECT_EQ(wrong(R"({"op":"ping","op":"ping"})"), Pointers{"/op"});
  EXPECT_EQ(wrong(R"({"op":"ping","id":1,"id":2})"), Pointers{"/id"});
  EXPECT_EQ(wrong(R"({"op":"ping","\u006fp":"ping"})"), Pointers{"/op"}) << "escaped";
  EXPECT_EQ(wrong(R"({"op":"ping","else":[5,{"a/b":1,"a/b":2,"a/b":3}]})"),
            (Pointers{"/else/1/a~1b", "/else/1/a~1b"}));
  EXPECT_EQ(wrong(R"({"op":"ping","else":[[],{},{"a":{"a":1,"b":2},"a":[1]}]})"),
            Pointers{"/else/2/a"});
  EXPECT_EQ(wrong(R"({"op":"auth","token":"secret","token":"other"})"), Pointers{"/token"});
}

TEST(MonitorRequest, DuplicatesInADocumentPointIntoIt) {
  EXPECT_EQ(wrong_in("snapshot_load", R"({"snapshot":{"state":{"tick":5,"tick":0}}})").front(),
            "/state/tick");
  EXPECT_EQ(wrong_in("workcell", R"({"workcell":{"name":"a","name":"b"}})").front(), "/name");
  EXPECT_EQ(wrong_in("workcell", R"({"workcell":{},"workcell":{}})").front(), "/args/workcell");
}

TEST(MonitorRequest, AcceptsTheSameNameInOtherObjects) {
  good(R"({"op":"ping","a":{"op":"a:b","x":"\":\""},"b":[{"op":1},{"op":{"op":"{:"}}]})");
}

TEST(MonitorRequest, RejectsManyAndLongDuplicates) {
  std::string members = R"({"op":"ping","id":7,")" + std::string(100'000, '/') + R"(":{)";
  while (members.size() < 250'000) members += R"("a":1,)";
  const RequestError error = bad(members + R"("a":1}})");
  EXPECT_EQ(error.id, RequestId{std::int64_t{7}});
  EXPECT_EQ(error.details.size(), 32U);
  EXPECT_LT(error.details.back().pointer.size(), 300U);
  EXPECT_EQ(bad(R"({"op":"ping",")" + std::string(100'000, 'x') + R"(":1,")" +
                std::string(100'000, 'x') + R"(":1})")
                .details.at(0)
                .found,
            "string of 100015 bytes");
}

}  // namespace
}  // namespace xr3::monitor
