#include "protocol/recording/entry_json.hpp"

#include <gtest/gtest.h>

#include <set>

#include "protocol/json/document.hpp"
#include "tests/support/models.hpp"

namespace xr3::recording {
namespace {

std::string every_byte() {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  return bytes;
}

std::vector<EntryBody> all_bodies() {
  return {
      LineBegin{1, "127.0.0.1:5000", LineKind::kTcp, Guard::kStrict},
      LineBegin{2, "/dev/\xff", LineKind::kPty, Guard::kOff},
      LineBegin{3, "monitor", LineKind::kMonitor, Guard::kNormal},
      LineSettings{1, *parse_serial_settings("9600-7e2"), true},
      LineSettings{1, {1200, std::nullopt}, false},
      LineSettings{1, *parse_serial_settings("300-8o1.5-rtscts"), false},
      LineInput{1, "E?", 2, 0, ""},
      LineInput{4'294'967'295, every_byte(), 3, 5, every_byte()},
      LineUnsent{1, 70'000},
      InputEnded{1},
      LineSilent{1},
      LineClosed{1, LineCloseReason::kFault},
      LineClosed{1, LineCloseReason::kNotARobotProgram},
      CallMade{call::Step{5}},
      Rewound{std::make_shared<const SavedCell>(SavedCell{"sha256:1", test::bare_workcell(), {}})},
      DeviceOpened{},
      DeviceLost{"unplugged: \xe9"},
      DeviceInput{"%"},
      DeviceOut{2},
      DeviceSilent{},
      Replies{1, every_byte()},
      StateHash{"sha256:12"},
      End{"sha256:12", "stopped"},
      End{"", "limit"}};
}

std::optional<Entry> read_text(const std::string& text, Findings* findings = nullptr,
                               Epoch epoch = 0) {
  const JsonDocument document(text);
  data::Reading reading(document.root(), data::Unit::kMm);
  auto entry = read_entry(reading, epoch);
  if (findings != nullptr) *findings = reading.take_findings();
  return entry;
}

TEST(RecordedEntry, EveryKindSurvivesTheRoundTrip) {
  std::set<std::size_t> kinds;
  for (const EntryBody& body : all_bodies()) {
    const Entry entry{3, 9'007'199'254'740'991, 999, body};
    const std::string text = members_of(entry, 2) + ",\"c\":\"AAAA\"}";
    const auto read = read_text(text);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(members_of(*read, 2) + ",\"c\":\"AAAA\"}", text);
    EXPECT_EQ(read->body.index(), body.index());
    EXPECT_EQ(read->us, 999);
    kinds.insert(body.index());
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<EntryBody>);
}

TEST(RecordedEntry, BytesAreExactAndTheLineIsAscii) {
  const std::string text = members_of({0, 5, 0, LineInput{1, every_byte(), 256, 0, ""}}, 0) + "}";
  EXPECT_EQ(std::get<LineInput>(read_text(text)->body).bytes, every_byte());
  for (const char c : text) EXPECT_TRUE(c >= ' ' && c < '\x7f');
  EXPECT_EQ(members_of({0, 5, 0, LineInput{1, "E+60\r", 5, 0, ""}}, 0),
            R"({"tick":5,"line":1,"in":"E+60\r")");
}

TEST(RecordedEntry, TheEpochIsWrittenWhenItChanges) {
  const Entry entry{4, 0, 0, InputEnded{1}};
  EXPECT_EQ(members_of(entry, 4).find("epoch"), std::string::npos);
  EXPECT_NE(members_of(entry, 3).find(R"("epoch":4)"), std::string::npos);
  EXPECT_EQ(read_text(members_of(entry, 4) + "}", nullptr, 4)->epoch, 4);
}

TEST(RecordedEntry, LateBytesOfVersion01AreRefused) {
  Findings findings;
  EXPECT_FALSE(read_text(R"({"tick":10,"acted":394,"behind":true,"c":"2LV-"})", &findings));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].pointer, "/acted");
  EXPECT_EQ(findings[0].found, "394");
  EXPECT_EQ(findings[0].allowed.find("no entry \"acted\": "), 0U) << findings[0].allowed;
  EXPECT_NE(findings[0].allowed.find("replay"), std::string::npos);
}

TEST(RecordedEntry, OtherMembersAndValuesAreRefusedWithTheirPointer) {
  const auto pointer = [](const std::string& text) {
    Findings findings;
    const auto entry = read_text(text, &findings);
    return entry || findings.empty() ? "accepted" : findings.front().pointer;
  };
  EXPECT_EQ(pointer(R"({"tick":-1,"line":1,"in":""})"), "/tick");
  EXPECT_EQ(pointer(R"({"line":1,"in":""})"), "/tick");
  EXPECT_EQ(pointer(R"({"tick":1,"in":""})"), "/line");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"in":"","hash":"x"})"), "/hash");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"in":"","inn":"x"})"), "/inn");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"in":"\u0100"})"), "/in");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"in":"a","taken":2})"), "/taken");
  EXPECT_EQ(pointer(R"({"tick":1,"line":0,"in":"a"})"), "/line");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"settings":"0-7e2","cooked":true})"), "/settings");
  EXPECT_EQ(pointer(R"({"tick":1})"), "");
  EXPECT_EQ(pointer(R"({"tick":1,"line":1,"open":"telnet","peer":"","guard":"off"})"), "/open");
  EXPECT_EQ(pointer(R"([])"), "");
}

}  // namespace
}  // namespace xr3::recording
