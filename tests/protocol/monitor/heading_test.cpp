// op, fn and id of a message, however the rest is written.
#include "protocol/monitor/heading.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

Heading call(RequestId id, const std::string& fn) { return {std::move(id), "call", fn}; }

void expect_same(const Heading& heading, const Heading& expected, const std::string& text) {
  EXPECT_EQ(heading.op, expected.op) << text;
  EXPECT_EQ(heading.fn, expected.fn) << text;
  EXPECT_EQ(heading.id, expected.id) << text;
}

TEST(MonitorHeading, IsReadFromAnyText) {
  const std::int64_t seven = 7;
  struct Row {
    std::string text;
    Heading heading;
  };
  const Row rows[] = {
      {R"({"op":"call","id":7,"fn":"step","args":{"ticks":1}})", call(seven, "step")},
      {R"(  { "args" : {"op":"ping","x":["}",{"id":1}]} , "fn" : "step", "id":"a",)"
       R"( "op" : "call" } )",
       call("a", "step")},
      {R"({"\u006fp":"c\u0061ll","i\u0064":"\u00e9","\u0066\u006e":"step"})", call("é", "step")},
      {R"({"op":"call","fn":"step","id":7,"args":{"ticks":[[[[[)", call(seven, "step")},
      {R"({"op":"call","fn":"step","id":7,"args":nonsense})", call(seven, "step")},
      {R"({"op":"call","fn":"step","id":7,"args":"no end)", call(seven, "step")},
      {R"({"op":"call","fn":"fly","id":7})", call(seven, "")},
      {R"({"op":"call","fn":{"a":1},"id":[7]})", call({}, "")},
      {R"({"op":"call","id":1e,"fn":"step"})", call({}, "step")},
      {R"({"op":"ping","op":"call"})", call({}, "")},
      {"{\"op\":\"call\",\"id\":\"" + std::string(64, 'x') + "\"}", call(std::string(64, 'x'), "")},
      {"{\"op\":\"call\",\"id\":\"" + std::string(65, 'x') + "\"}", call({}, "")},
      {R"({"op":"get","channel":5})", {{}, "get", ""}},
      {R"({"op":"dance","id":7})", {seven, "", ""}},
      {R"({"op":5})", {}},
      {R"({"op")", {}},
      {R"({"op":)", {}},
      {R"({"op":"call)", {}},
      {R"({"op" "call"})", {}},
      {R"([{"op":"call"}])", call({}, "")},
      {"{", {}},
      {"", {}},
      {"]", {}},
      {R"({"a":]]],"op":"call"})", {}},
  };
  for (const Row& row : rows) expect_same(heading_of(row.text), row.heading, row.text);
}

TEST(MonitorHeading, OfAParsedRequestEqualsThatOfItsText) {
  for (const std::string text :
       {R"({"op":"call","id":7,"fn":"step","args":{"ticks":1}})",
        R"({"op":"get","channel":"state"})", R"({"op":"sub","id":"x","channel":"event"})"}) {
    const RequestReading reading = read_request(text);
    expect_same(heading_of(std::get<Request>(reading)), heading_of(text), text);
  }
}

}  // namespace
}  // namespace xr3::monitor
