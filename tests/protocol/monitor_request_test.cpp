// What clients may say, and what they hear when it is wrong: every request, every error code.
#include "protocol/monitor_request.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3::monitor {
namespace {

const std::vector<std::string> kCells = {"main", "second"};

Request good(const std::string& text) {
  RequestReading reading = read_request(text, kCells);
  const auto* error = std::get_if<RequestError>(&reading);
  EXPECT_EQ(error, nullptr) << text << ": " << (error == nullptr ? "" : error->message);
  return error == nullptr ? std::get<Request>(reading) : Request{};
}

RequestError bad(const std::string& text) {
  RequestReading reading = read_request(text, kCells);
  const auto* error = std::get_if<RequestError>(&reading);
  EXPECT_NE(error, nullptr) << text;
  return error == nullptr ? RequestError{} : *error;
}

template <class Call>
Call call_of(const std::string& fn, const std::string& args) {
  const Request request = good(R"({"op":"call","fn":")" + fn + R"(","args":)" + args + "}");
  return std::get<Call>(std::get<CallRequest>(request.what).call);
}

/// Pointers of the details that a call is answered with.
std::vector<std::string> wrong_in(const std::string& fn, const std::string& args) {
  const RequestError error = bad(R"({"op":"call","fn":")" + fn + R"(","args":)" + args + "}");
  EXPECT_EQ(error.code, "bad_args") << args;
  std::vector<std::string> pointers;
  for (const Detail& detail : error.details) pointers.push_back(detail.pointer);
  return pointers;
}

using Pointers = std::vector<std::string>;

TEST(MonitorRequest, PingWithEveryKindOfId) {
  EXPECT_EQ(good(R"({"op":"ping"})").id, RequestId{});
  EXPECT_EQ(good(R"({"op":"ping","id":null})").id, RequestId{});
  EXPECT_EQ(good(R"({"op":"ping","id":16})").id, RequestId{std::int64_t{16}});
  EXPECT_EQ(good(R"({"op":"ping","id":-9007199254740991})").id, RequestId{-kMostInteger});
  EXPECT_EQ(good(R"({"op":"ping","id":"a"})").id, RequestId{std::string("a")});
  EXPECT_EQ(good(R"({"op":"ping","id":")" + std::string(64, 'x') + R"("})").id,
            RequestId{std::string(64, 'x')});
}

TEST(MonitorRequest, IdsThatAreNone) {
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

TEST(MonitorRequest, Get) {
  const Request request = good(
      R"({"op":"get","id":5,"channel":"state","fields":["stalled","moving","stalled","tick"]})");
  const Get& get = std::get<Get>(request.what);
  EXPECT_EQ(get.channel, "state");
  EXPECT_EQ(get.fields, (Fields{{"stalled", "moving", "tick"}}));
  EXPECT_EQ(std::get<Get>(good(R"({"op":"get","channel":"state"})").what).fields, std::nullopt);
}

TEST(MonitorRequest, UnknownMembersAreIgnored) {
  good(R"({"op":"ping","why":{"not":[1,2]}})");
  good(R"({"op":"get","channel":"state","encoding":"rle","since":4})");
  good(R"({"op":"call","fn":"home","comment":"hello"})");
}

TEST(MonitorRequest, CellsByName) {
  EXPECT_EQ(good(R"({"op":"ping"})").cell, "main");
  EXPECT_EQ(good(R"({"op":"ping","cell":"second"})").cell, "second");
  EXPECT_EQ(bad(R"({"op":"ping","cell":"third"})").code, "unknown_cell");
  EXPECT_EQ(bad(R"({"op":"ping","cell":1})").code, "unknown_cell");
}

TEST(MonitorRequest, CallsWithoutArgs) {
  for (const std::string fn : {"pause", "resume", "reset", "home"}) {
    const std::string start = R"({"op":"call","fn":")" + fn + "\"";
    EXPECT_EQ(std::get<CallRequest>(good(start + "}").what).fn, fn);
    good(start + R"(,"args":{}})");
    EXPECT_EQ(wrong_in(fn, R"({"ticks":1})"), Pointers{"/args/ticks"});
    EXPECT_EQ(wrong_in(fn, "7"), Pointers{"/args"});
  }
}

TEST(MonitorRequest, RateInExactMillionths) {
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

TEST(MonitorRequest, StepTicks) {
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":200})").ticks, 200);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":0})").ticks, 0);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":2e2})").ticks, 200);
  EXPECT_EQ(call_of<call::Step>("step", R"({"ticks":9007199254740991})").ticks, kMostInteger);
  for (const char* ticks :
       {"-1", "1.5", "9007199254740992", "18446744073709551615", "1e19", "\"5\"", "null", "[5]"}) {
    EXPECT_EQ(wrong_in("step", std::string(R"({"ticks":)") + ticks + "}"), Pointers{"/args/ticks"})
        << ticks;
  }
  EXPECT_EQ(wrong_in("step", "{}"), Pointers{"/args/ticks"});
}

TEST(MonitorRequest, StepAfterABarrier) {
  const Request request = good(
      R"({"op":"call","id":8,"fn":"step","args":{"ticks":50,"after":{"line":3,"bytes_in":120,"within_ms":2000},"fields":["joints"]}})");
  const auto& wanted = std::get<CallRequest>(request.what);
  ASSERT_TRUE(wanted.after);
  EXPECT_EQ(wanted.after->line, 3U);
  EXPECT_EQ(wanted.after->bytes_in, 120U);
  EXPECT_EQ(wanted.after->within_ms, 2000);
  EXPECT_EQ(wanted.fields, (Fields{{"joints"}}));
}

TEST(MonitorRequest, TheBarrierWaitsASecondUnlessTold) {
  const Request request =
      good(R"({"op":"call","fn":"step","args":{"ticks":5,"after":{"line":1,"bytes_in":0}}})");
  EXPECT_EQ(std::get<CallRequest>(request.what).after->within_ms, 1000);
}

TEST(MonitorRequest, RunUntil) {
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

TEST(MonitorRequest, EveryWrongFieldIsTold) {
  const RequestError error = bad(
      R"({"op":"call","id":[],"fn":"step","args":{"ticks":-1,"a/b":2,"after":{"line":0,"x":1,"within_ms":60001},"fields":["nope",3]}})");
  EXPECT_EQ(error.message, "9 wrong fields");
  EXPECT_EQ(error.hint, "nothing was changed");
  Pointers pointers;
  for (const Detail& detail : error.details) pointers.push_back(detail.pointer);
  EXPECT_EQ(pointers, (Pointers{"/id", "/args/ticks", "/args/after/line", "/args/after/bytes_in",
                                "/args/after/within_ms", "/args/after/x", "/args/fields/0",
                                "/args/fields/1", "/args/a~1b"}));
  EXPECT_EQ(error.details[1].found, -1);
  EXPECT_EQ(error.details[1].allowed, "a whole number 0...9007199254740991");
  EXPECT_EQ(error.details[3].found, nullptr);
}

TEST(MonitorRequest, WhatIsWrongIsToldBriefly) {
  std::string members;
  for (int i = 0; i < 5000; ++i) members += ",\"x" + std::to_string(i) + "\":0";
  const RequestError error = bad(R"({"op":"call","fn":"step","args":{"ticks":")" +
                                 std::string(9999, 'y') + "\"" + members + "}}");
  EXPECT_EQ(error.message, "5001 wrong fields, the first of them in details");
  EXPECT_EQ(error.details.size(), 32U);
  EXPECT_EQ(error.details[0].found, "string of 10001 bytes");
}

TEST(MonitorRequest, UnknownNamesAndWhatThereIs) {
  struct Row {
    const char* text;
    const char* code;
    const char* message;
  };
  const Row rows[] = {
      {R"({"id":1})", "unknown_op", "the request names no op"},
      {R"({"id":1,"op":"sub","channel":"state"})", "unknown_op", R"(there is no op "sub")"},
      {R"({"id":1,"op":["ping"]})", "unknown_op", R"(there is no op ["ping"])"},
      {R"({"id":1,"op":"get"})", "unknown_channel", "the request names no channel"},
      {R"({"id":1,"op":"get","channel":"image"})", "unknown_channel",
       R"(there is no channel "image")"},
      {R"({"id":1,"op":"call"})", "unknown_fn", "the request names no fn"},
      {R"({"id":1,"op":"call","fn":"send"})", "unknown_fn", R"(there is no fn "send")"},
  };
  for (const Row& row : rows) {
    const RequestError error = bad(row.text);
    EXPECT_EQ(error.code, row.code) << row.text;
    EXPECT_EQ(error.message, row.message);
    EXPECT_EQ(error.id, RequestId{std::int64_t{1}});
    EXPECT_FALSE(error.hint.empty());
  }
  EXPECT_EQ(bad(R"({"op":"sub"})").hint, R"(there is "get", "call" or "ping")");
}

TEST(MonitorRequest, BrokenJsonInPlainWords) {
  const std::string where = "line 1, column ";
  EXPECT_EQ(bad(R"({"op":"ping)").message,
            where + "12: text without its closing quote; allowed: text in double quotes");
  EXPECT_EQ(bad(R"({"op":"ping")").message,
            where + "13: the end of the message; allowed: a comma or }");
  EXPECT_EQ(bad(R"({"op":"ping"} {)").message,
            where + "15: {; allowed: nothing after the end of the value");
  EXPECT_EQ(bad(std::string(R"({"op":"ping"})") + '\0' + "{").message,
            where + "14: a NUL byte; allowed: JSON in UTF-8");
  for (const char* text :
       {"{", "{]", "{'op':1}", "{\"a\":\"\xff\"}", "{\"a\":1e999}", "{\"a\":01}",
        "{\"a\":\"\x01\"}", "{\"a\":nul}", "{\"a\":\"\\ud800\"}", "[1]", "7", ""}) {
    const RequestError error = bad(text);
    EXPECT_EQ(error.code, "bad_json") << text;
    EXPECT_EQ(error.id, RequestId{});
    EXPECT_EQ(error.message.rfind(where, 0), 0U) << error.message;
  }
}

TEST(MonitorRequest, DepthIsBounded) {
  const auto nested = [](int depth) {
    const auto lists = static_cast<std::size_t>(depth - 1);
    return R"({"op":"ping","x":)" + std::string(lists, '[') + std::string(lists, ']') + "}";
  };
  good(nested(32));
  EXPECT_EQ(bad(nested(33)).code, "too_deep");
  EXPECT_EQ(bad(nested(100'000)).code, "too_deep");
  good(R"({"op":"ping","x":")" + std::string(100, '[') + R"(\"[["})");
}

TEST(MonitorRequest, LengthIsBounded) {
  const std::string start = R"({"op":"ping","x":")";
  good(start + std::string(kMostMessageBytes - start.size() - 2, 'x') + "\"}");
  EXPECT_EQ(bad(start + std::string(kMostMessageBytes - start.size() - 1, 'x') + "\"}").code,
            "too_long");
}

TEST(MonitorRequest, NoTickBeyondWhatCanBeSaid) {
  Request step = good(R"({"op":"call","id":3,"fn":"step","args":{"ticks":10}})");
  EXPECT_FALSE(fit(step, kMostInteger - 10));
  const auto error = fit(step, kMostInteger - 9);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, "bad_args");
  EXPECT_EQ(error->id, RequestId{std::int64_t{3}});

  Request run =
      good(R"({"op":"call","fn":"run_until","args":{"idle":true,"max_ticks":9007199254740991}})");
  EXPECT_FALSE(fit(run, 1000));
  EXPECT_EQ(std::get<call::RunUntil>(std::get<CallRequest>(run.what).call).max_ticks,
            kMostInteger - 1000);
}

}  // namespace
}  // namespace xr3::monitor
