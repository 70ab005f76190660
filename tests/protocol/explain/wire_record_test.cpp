// Records of a line: no byte is lost for any division of the input, and explanations lie within the
// bytes that they explain.
#include "protocol/explain/wire_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor/event.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/models.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/support/tap.hpp"

namespace xr3 {
namespace {

using test::Tap;

ModelPtr seeing_rhino(Profile profile) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                       test::workcell_named("rhino-xr3"), profile);
}

TEST(WireRecord, ShowsInputBytes) {
  Tap tap(test::rhino());
  tap.send("E+5\rE?");
  const Model& model = tap.simulation().model();
  ASSERT_EQ(tap.records().size(), 2U);
  EXPECT_EQ(wire_json(tap.records()[0], model).dump(),
            R"({"line":1,"dir":"in","offset":0,"hex":"452b350d453f","text":"E+5\\rE?","bytes":6,)"
            R"("parsed":[{"from":0,"to":4,"code":"move","message":"move E +5, counter 5"},)"
            R"({"from":4,"to":6,"code":"query_error",)"
            R"("message":"asks how far E has still to go"}]})");
  EXPECT_EQ(wire_json(tap.records()[1], model).dump(),
            R"({"line":1,"dir":"out","offset":0,"hex":"25","text":"%","bytes":1,)"
            R"("parsed":[{"from":0,"to":1,"code":"reply_error",)"
            R"("message":"E: 5 counts to go"}]})");
}

TEST(WireRecord, ALongReplyIsTruncatedButCounted) {
  Tap tap(seeing_rhino(Profile::kPaper));
  tap.send("A**");
  const WireRecord& out = tap.records().back();
  EXPECT_EQ(out.bytes, 192U * 192U / 6U);
  EXPECT_EQ(out.shown, tap.received().substr(0, kMaxShownOut));
  EXPECT_EQ(out.items.at(0).to, out.bytes);
}

TEST(WireRecord, ReusesTheMemoryOfAnOldRecord) {
  Tap tap(test::rhino());
  tap.send("E?D?C?B?A?ZZZZZZZZZZZZZZZZZZZZZZZZZZZ");
  WireRecord record = tap.records().front();
  const wire::Item* items = record.items.data();
  const char* shown = record.shown.data();
  RhinoEndpoint endpoint(Profile::kPaper);
  std::vector<Exchange> exchanges;
  std::string replies;
  test::feed(endpoint, 'I', 7, tap.simulation(), replies, exchanges);
  fill_in(record, {2, 3, 4, 7}, "I", std::nullopt, exchanges, tap.simulation());
  EXPECT_EQ(record.items.data(), items);
  EXPECT_EQ(record.shown.data(), shown);
  EXPECT_EQ(test::transcript(record, tap.simulation().model()),
            "> I\n"
            "  7..8 query_switches_i: asks for the microswitches of C...H\n");
  EXPECT_EQ(record.epoch, 2);
  EXPECT_EQ(record.tick, 3);
  EXPECT_EQ(record.line, 4U);
}

/// A line under random bytes, in random pieces, while time passes.
struct Hammered {
  Tap tap;
  std::string sent;

  Hammered(std::uint32_t seed, Profile profile) : tap(seeing_rhino(profile)) {
    test::RandomBytes random(seed);
    sent = "\r" + random.stream(300);  // neither HTTP nor TLS begins with CR
    std::string_view rest = sent;
    while (!rest.empty()) {
      const std::size_t piece = std::min<std::size_t>(rest.size(), 1 + random.below(90));
      tap.send(rest.substr(0, piece));
      rest.remove_prefix(piece);
      tap.simulation().advance_to(tap.simulation().tick() + random.below(200));
    }
  }
};

// A number at the end of the previous record is completed by the first byte of this one, so items
// of input may start before their record. Replies lie within theirs.
void expect_items_within(const WireRecord& record) {
  const bool is_in = record.direction == Direction::kIn;
  std::uint64_t last = is_in ? 0 : record.offset;
  for (const wire::Item& item : record.items) {
    ASSERT_LT(item.from, item.to);
    ASSERT_LE(item.to, record.offset + record.bytes);
    ASSERT_GE(is_in ? item.to : item.from, last) << "in the order in which they were completed";
    last = item.to;
  }
}

void expect_good_json(const WireRecord& record, const Model& model) {
  const Json json = wire_json(record, model);
  ASSERT_EQ(Json::parse(json.dump()), json);  // dump() throws on text that is not UTF-8
  ASSERT_EQ(json["hex"].get_ref<const std::string&>().size(), 2 * record.shown.size());
  std::uint64_t last = 0;
  for (const Json& item : json["parsed"]) {
    ASSERT_LT(item["from"], item["to"]);
    ASSERT_GE(item["to"].get<std::uint64_t>(), last);
    ASSERT_NE(item["code"], "");
    ASSERT_NE(item["message"], "");
    last = item["to"].get<std::uint64_t>();
  }
}

TEST(WireRecord, LosesNoRandomBytes) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Hammered line(seed, seed % 2 == 0 ? Profile::kPaper : Profile::kMark3);
    std::string in;
    std::uint64_t out = 0;
    for (const WireRecord& record : line.tap.records()) {
      const bool is_in = record.direction == Direction::kIn;
      ASSERT_EQ(record.offset, is_in ? in.size() : out);
      if (is_in) in += record.shown;
      if (!is_in) out += record.bytes;
      ASSERT_EQ(record.shown.size(), std::min<std::uint64_t>(record.bytes, is_in ? 64 : 256));
      ASSERT_NO_FATAL_FAILURE(expect_items_within(record));
      ASSERT_NO_FATAL_FAILURE(expect_good_json(record, *test::rhino()));
    }
    EXPECT_EQ(in, line.sent);
    EXPECT_EQ(out, line.tap.received().size());
  }
}

// Every sent byte belongs to a reply or to telnet, and is explained.
TEST(WireRecord, ExplainsEveryOutputByte) {
  for (std::uint32_t seed = 100; seed < 120; ++seed) {
    const Hammered line(seed, Profile::kPaper);
    for (const WireRecord& record : line.tap.records()) {
      if (record.direction == Direction::kIn) continue;
      std::uint64_t last = record.offset;
      const Json json = wire_json(record, *test::rhino());
      for (const Json& item : json["parsed"]) {
        ASSERT_EQ(item["from"].get<std::uint64_t>(), last) << json;
        last = item["to"].get<std::uint64_t>();
      }
      ASSERT_EQ(last, record.offset + record.bytes) << json;
    }
  }
}

}  // namespace
}  // namespace xr3
