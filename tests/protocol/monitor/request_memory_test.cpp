// Memory needed for reading a request or a file: a small multiple of its size, whatever its
// structure.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "protocol/check/check_report.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"
#include "tests/protocol/monitor/requests.hpp"
#include "tests/support/allocations.hpp"

namespace xr3::monitor {
namespace {

constexpr std::size_t kMaxTimes = 10;
constexpr std::size_t kConstant =
    96 * 1024;  // details of 32 invalid members, tables, parser stacks

/// `begin`, then `item` repeated, then `end`, with at most `size` bytes.
std::string filled(const std::string& begin, const std::string& item, const std::string& end,
                   std::size_t size = kMaxMessageBytes) {
  std::string text = begin;
  text.reserve(size);
  const std::string last = item.ends_with(',') ? item.substr(0, item.size() - 1) : item;
  while (text.size() + item.size() + last.size() + end.size() <= size) text += item;
  return text + last + end;
}

/// The same with a running number instead of `#` in each item.
std::string numbered(const std::string& begin, const std::string& item, const std::string& end,
                     std::size_t size = kMaxMessageBytes) {
  std::string text = begin;
  text.reserve(size);
  const std::size_t place = item.find('#');
  for (int i = 0;; ++i) {
    std::string next = item;
    next.replace(place, 1, std::to_string(i));
    if (text.size() + 2 * next.size() + end.size() > size)
      return text + next.substr(0, next.size() - 1) + end;
    text += next;
  }
}

struct Shape {
  std::string name;
  std::string text;
};

std::string in_workcell(const std::string& members) {
  return R"({"op":"call","id":1,"fn":"workcell","args":{"workcell":{)" + members + "}}}";
}

const std::string kWorkcell = R"({"op":"call","id":1,"fn":"workcell","args":{"workcell":{)";
const std::string kSnapshot = R"({"op":"call","id":1,"fn":"snapshot_load","args":{"snapshot":{)";
const std::string kBlocks =
    kWorkcell + R"("name":"w","length_unit":"mm","workspace":{"x":1,"y":1,"z":1},"blocks":[)";
const std::string kState = kSnapshot + R"("robot_hash":"","workcell":{},"state":{)";
const std::string kLongName(131'000, 'n');

std::vector<Shape> shapes() {
  const std::string zeros = filled("[", "0,", "]", 131'000);
  return {
      {"a long name with many zeros", in_workcell("\"" + kLongName + "\":" + zeros)},
      {"the same in a snapshot", kSnapshot + "\"" + kLongName + "\":" + zeros + "}}}"},
      {"a long name with many members",
       filled(kWorkcell + "\"" + kLongName + "\":{", "\"a\":0,", "}}}}")},
      {"zeros beside the args", filled(R"({"op":"ping","a":[)", "0,", "]}")},
      {"zeros as blocks", filled(kBlocks, "0,", "]}}}")},
      {"ten thousand zeros as blocks", filled(kBlocks, "0,", "]}}}", 20'000)},
      {"ten thousand objects as blocks", filled(kBlocks, "{},", "]}}}", 30'000)},
      {"objects as blocks", filled(kBlocks, "{},", "]}}}")},
      {"blocks of one unknown member", filled(kBlocks, R"({"":0},)", "]}}}", 70'000)},
      {"blocks",
       numbered(kBlocks, R"({"name":"#","size":[1,1,1],"centroid":[0,0,0],"yaw_deg":0,"color":0},)",
                "]}}}")},
      {"blocks with one wrong member",
       numbered(kBlocks,
                R"({"name":"#","size":[1,1,1],"centroid":[0,0,0],"yaw_deg":0,"color":99},)",
                "]}}}")},
      {"blocks of one name",
       filled(kBlocks, R"({"name":"b","size":[1,1,1],"centroid":[0,0,0],"yaw_deg":0,"color":0},)",
              "]}}}")},
      {"lying blocks",
       numbered(kState + "\"blocks\":[",
                R"({"name":"#","size_um":[1,1,1],"centroid_um":[0,0,0],"yaw_udeg":0,"color":0},)",
                "]}}}}")},
      {"a path",
       filled(kState + R"("tip_path":{"oldest":0,"points":[)", "[0,0,0],", "]}}}}}", 33'000)},
      {"a path that is too long",
       filled(kState + R"("tip_path":{"oldest":0,"points":[)", "[0,0,0],", "]}}}}}")},
      {"empty objects", filled(R"({"op":"ping","a":[)", "{},", "]}")},
      {"empty lists", filled(R"({"op":"ping","a":[)", "[],", "]}")},
      {"members that are empty objects", numbered(R"({"op":"ping","a":{)", "\"#\":{},", "}}")},
      {"members in args",
       numbered(R"({"op":"call","fn":"step","args":{"ticks":1,)", "\"#\":0,", "}}")},
      {"lists of lists",
       filled(R"({"op":"ping","a":[)", "[[[[[[[[[[[[[[[[[[[[[[[[[[[[0]]]]]]]]]]]]]]]]]]]]]]]]]]]],",
              "]}")},
      {"objects in objects",
       filled(R"({"op":"ping","a":[)", R"({"a":{"a":{"a":{"a":{"a":{"a":{"":0}}}}}}},)", "]}")},
      {"duplicates", filled(R"({"op":"ping","a":{)", "\"a\":0,", "}}")},
      {"duplicates without a name", filled(R"({"op":"ping","a":{)", "\"\":0,", "}}")},
      {"duplicates under a long name",
       filled(R"({"op":"ping",")" + kLongName + "\":{", "\"a\":0,", "}}")},
      {"duplicates of a long name",
       R"({"op":"ping",")" + kLongName + R"(":1,")" + kLongName + R"(":1})"},
      {"one long text", filled(R"({"op":"ping","a":")", "x", "\"}")},
      {"a text of escapes", filled(R"({"op":"ping","a":")", R"(\u00e9)", "\"}")},
      {"a long text that is wrong",
       filled(R"({"op":"call","fn":"step","args":{"ticks":")", R"(\n)", "\"}}")},
      {"a long number", filled(R"({"op":"call","fn":"step","args":{"ticks":1)", "0", "}}", 300)},
      {"a long fraction", filled(R"({"op":"call","fn":"step","args":{"ticks":0.)", "1", "}}")},
      {"a long id", filled(R"({"op":"ping","id":")", "x", "\"}")},
      {"a list as id", filled(R"({"op":"ping","id":[)", "0,", "]}")},
      {"a long op", filled(R"({"op":")", R"(\u0001)", "\"}")},
      {"a list as op", filled(R"({"op":[)", "1e5,", "]}")},
      {"members as cell", numbered(R"({"op":"ping","cell":{)", "\"#\":0,", "}}")},
      {"many fields", filled(R"({"op":"get","channel":"state","fields":[)", "0,", "]}")},
      {"a field many times",
       filled(R"({"op":"get","channel":"state","fields":[)", "\"io\",", "]}")},
      {"hexadecimal", filled(R"({"op":"call","fn":"send","args":{"hex":")", "00", "\"}}")},
      {"a long text to send", filled(R"({"op":"call","fn":"send","args":{"text":")", "a", "\"}}")},
      {"no JSON, after many zeros", filled(R"({"op":"ping","a":[)", "0,", ",")},
      {"no JSON, a text", filled(R"({"op":"ping","a":")", "x", "")},
      {"no UTF-8", filled(R"({"op":"ping","a":")", "x", "\xff\"}")},
      {"a number that is too large", filled(R"({"op":"ping","id":1)", "0", "}")},
      {"a control character", filled(R"({"op":"ping","a":")", "x", "\n\"}")},
      {"half a surrogate pair", filled(R"({"op":"ping","a":")", "x", R"(\ud800"})")},
      {"two long texts",
       filled(R"({"op":"ping","a":")", "x", "\"", 131'000) + filled(R"(,"b":")", "x", "", 131'000)},
      {"blanks", filled(R"({"op":"ping","a":1)", " ", "}")},
  };
}

using Milliseconds = std::chrono::duration<double, std::milli>;

TEST(RequestMemory, IsAtMostTenTimesTheMessage) {
  read_request(R"({"op":"call","fn":"describe"})");  // creates static tables
  read_request(R"({"op":"call","fn":"workcell","args":{"workcell":{}}})");
  read_request(R"({"op":"call","fn":"snapshot_load","args":{"snapshot":{}}})");
  for (const Shape& shape : shapes()) {
    ASSERT_LE(shape.text.size(), kMaxMessageBytes) << shape.name;
    const auto started = std::chrono::steady_clock::now();
    const test::Allocations allocations;
    RequestReading reading = read_request(shape.text);
    std::size_t answer = 0;
    if (const auto* error = std::get_if<RequestError>(&reading)) answer = result(*error)->size();
    const std::size_t peak = allocations.peak();
    const Milliseconds took = std::chrono::steady_clock::now() - started;
    EXPECT_LE(peak, kMaxTimes * shape.text.size() + kConstant) << shape.name;
    EXPECT_LE(answer, 48U * 1024) << shape.name;
    if (std::getenv("XR3_SHOW") != nullptr)
      printf("%-36s %7zu bytes %6.2f x %8.1f ms  answer %zu\n", shape.name.c_str(),
             shape.text.size(), static_cast<double>(peak) / static_cast<double>(shape.text.size()),
             took.count(), answer);
  }
}

}  // namespace
}  // namespace xr3::monitor
