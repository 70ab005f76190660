// A cell with a physical controller: what goes there, when, and to whom the replies go.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "protocol/monitor/event.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"

namespace xr3 {
namespace {

constexpr WallNs kDeviceMs = 1'000'000;

class DeviceTest : public testing::Test {
 protected:
  explicit DeviceTest(bool is_mirrored = false) {
    cell_.connect_device("/dev/ttyUSB0", {9600, SerialFrame{}}, is_mirrored);
    cell_.apply(DeviceOpened{}, now_);
    for (LineId line = 1; line <= 2; ++line) cell_.apply(LineOpened{"test"}, now_);
    events_.clear();
  }

  /// Sends bytes on a line and returns its replies.
  std::string send(LineId line, std::string_view bytes) {
    cell_.apply(BytesIn{line, bytes}, now_);
    return replies(line);
  }
  std::string replies(LineId line) {
    const std::string bytes(cell_.find_line(line)->outbox());
    cell_.sent({line, bytes.size()});
    return bytes;
  }
  /// The bytes that leave for the device now.
  std::string leaving() {
    std::string bytes;
    while (!cell_.device()->outbox().empty()) {
      const std::size_t count = cell_.device()->outbox().size();
      bytes += cell_.device()->outbox();
      cell_.apply(DeviceOut{count}, now_);
    }
    return bytes;
  }
  void answer(std::string_view bytes) { cell_.apply(DeviceIn{bytes}, now_); }
  call::Outcome call(call::Call call) { return cell_.apply(Input{call}, now_).outcome; }
  void pass(int ms) { cell_.catch_up(now_ += ms * kDeviceMs); }
  /// The codes of the events since the last call.
  std::vector<std::string> codes() {
    std::vector<std::string> all;
    for (const CellEvent& event : events_)
      all.emplace_back(event_json(event, cell_.model())["code"]);
    events_.clear();
    return all;
  }
  using Codes = std::vector<std::string>;
  /// The sentences of the events since the last call.
  std::vector<std::string> sentences() {
    std::vector<std::string> all;
    for (const CellEvent& event : events_)
      all.emplace_back(event_json(event, cell_.model())["message"]);
    events_.clear();
    return all;
  }
  /// The explanations of the last record of the lines.
  std::vector<std::string> explained() {
    const Json record = Json::parse(*cell_.wires().at(cell_.wires().next() - 1));
    std::vector<std::string> all;
    for (const Json& each : record["parsed"]) all.emplace_back(each["message"]);
    return all;
  }

  WallNs now_ = 0;
  std::vector<CellEvent> events_;
  Cell cell_{"main", test::rhino(), SimClock::real(Rate{}, 0)};
  test::OnEvent on_event_{cell_, [this](const CellEvent& each) { events_.push_back(each); }};
};

TEST_F(DeviceTest, GetsNothingWhileTheSimulatorIsEnabled) {
  EXPECT_EQ(send(1, "E+5\rE?"), "%");
  EXPECT_EQ(send(1, "A@A@E?"), "%");
  EXPECT_EQ(leaving(), "");
}

TEST_F(DeviceTest, GetsWholeCommandsWhileItIsDisabled) {
  send(1, "A@E");
  EXPECT_EQ(leaving(), "") << "the command is unfinished";
  send(1, "+5");
  send(2, "F?");
  EXPECT_EQ(leaving(), "F?");
  answer("!");
  send(1, "0\r");
  EXPECT_EQ(leaving(), "E+50\r");
  EXPECT_EQ(replies(2), "!");
  EXPECT_EQ(replies(1), "");
}

TEST_F(DeviceTest, ReplacesTheSelectedJointByItsName) {
  send(1, "A@E+5");
  send(2, "F-3\r");
  send(1, "?");
  EXPECT_EQ(leaving(), "F-3\rE+5\rE?");
}

TEST_F(DeviceTest, EachReplyGoesToTheLineThatAsked) {
  send(1, "A@E?");
  send(2, "F?");
  EXPECT_EQ(leaving(), "E?");
  answer("1");
  EXPECT_EQ(leaving(), "F?");
  answer("2");
  EXPECT_EQ(replies(1), "1");
  EXPECT_EQ(replies(2), "2");
  EXPECT_EQ(cell_.take_woken_lines(), (std::vector<LineId>{1, 2}));
}

TEST_F(DeviceTest, TheSimulatedMachineDoesNotMove) {
  send(1, "A@E+5\rA$");
  pass(1000);
  EXPECT_EQ(cell_.state().motor(cell_.model().index_of('E')).count, 0);
  EXPECT_TRUE(cell_.is_at_rest());
}

TEST_F(DeviceTest, SwitchingBackIsConsumedAndDropsUnfinishedCommands) {
  send(1, "A@");
  send(2, "E+5");
  send(1, "A @");
  EXPECT_EQ(codes(), (Codes{"disabled", "enabled"}));
  EXPECT_EQ(send(2, "0\rE?"), " ") << "E+5 was dropped, and 0 has no joint";
  EXPECT_EQ(leaving(), "");
}

TEST_F(DeviceTest, CommandsOfTheSimulatorAndBytesOf8BitsAreNotSent) {
  send(1, "A@");
  codes();
  for (const char* bytes : {"ET", "EV", "A$", "A#", "A**", "\xc5", "\xff\xff"}) {
    send(1, bytes);
    EXPECT_EQ(codes(), Codes{"not_for_device"}) << bytes;
  }
  send(1, "y");
  EXPECT_EQ(codes(), Codes{"unknown_byte"});
  EXPECT_EQ(leaving(), "");
}

TEST_F(DeviceTest, ASilentDeviceIsReportedToTheLineAndTheNextOneIsServed) {
  send(1, "A@E?");
  send(2, "F?");
  EXPECT_EQ(leaving(), "E?");
  codes();
  pass(502);
  EXPECT_TRUE(codes().empty());
  EXPECT_TRUE(cell_.has_news_to_come());
  pass(1);
  EXPECT_EQ(codes(), Codes{"device_silent"});
  EXPECT_EQ(leaving(), "F?");
  answer("2");
  EXPECT_EQ(replies(1), "");
  EXPECT_EQ(replies(2), "2");
}

TEST_F(DeviceTest, BytesThatNobodyAskedForGoToNoLine) {
  send(1, "A@");
  codes();
  answer("xyz");
  EXPECT_EQ(codes(), Codes{"device_unasked"});
  EXPECT_EQ(replies(1) + replies(2), "");
}

TEST_F(DeviceTest, AReplyToAClosedLineIsDiscarded) {
  send(1, "A@E?E+");
  cell_.apply(LineClosed{1}, now_);
  EXPECT_EQ(leaving(), "E?");
  codes();
  answer("1");
  EXPECT_TRUE(codes().empty());
  EXPECT_EQ(replies(2), "");
}

TEST_F(DeviceTest, AFloodWaitsUntilTheDeviceHasTakenIt) {
  std::string flood = "A@E?";
  for (int i = 0; i < 1000; ++i) flood += "E+1\r";
  const std::size_t taken = cell_.apply(BytesIn{1, flood}, now_).bytes_taken;
  EXPECT_LT(taken, 500U);
  EXPECT_FALSE(accepts(cell_.value(), *cell_.find_line(1), 'E'));
  EXPECT_TRUE(accepts(cell_.value(), *cell_.find_line(2), 'E'));
  answer("1");
  EXPECT_TRUE(accepts(cell_.value(), *cell_.find_line(1), 'E'));
  EXPECT_EQ(cell_.take_woken_lines(), std::vector<LineId>{1});
}

TEST_F(DeviceTest, StopWorksInEveryState) {
  send(1, "A@E+50\rE?E+50\r");
  call(call::StopDevice{});
  EXPECT_EQ(leaving(), "AXBXCXDXEXFXGXHX");
  send(1, "A@");
  codes();
  call(call::StopDevice{});
  EXPECT_EQ(leaving(), "AXBXCXDXEXFXGXHX");
  EXPECT_EQ(codes(), Codes{"device_stopped"});
}

TEST_F(DeviceTest, AStopOfAnAbsentDeviceIsRefused) {
  cell_.apply(DeviceLost{"unplugged"}, now_);
  EXPECT_EQ(std::get<call::Refused>(call(call::StopDevice{})).code, "no_device");
}

TEST_F(DeviceTest, CommandsForAnAbsentDeviceAreDropped) {
  send(1, "A@E?");
  cell_.apply(DeviceLost{"unplugged"}, now_);
  send(1, "E+5\rE?");
  cell_.apply(DeviceOpened{}, now_);
  EXPECT_EQ(leaving(), "");
  EXPECT_EQ(codes(), (Codes{"disabled", "device_lost", "device_opened"}));
  EXPECT_FALSE(cell_.device()->deadline());
}

TEST_F(DeviceTest, ASnapshotDoesNotOpenTheWayToTheDevice) {
  send(1, "A@");
  call(call::SaveSnapshot{"disabled"});
  call(call::Reset{});
  EXPECT_TRUE(cell_.state().enabled);
  call(call::LoadSnapshot{"disabled", nullptr});
  EXPECT_FALSE(cell_.state().enabled);
  codes();
  send(1, "E?");
  EXPECT_EQ(leaving(), "");
  EXPECT_EQ(codes(), Codes{"disabled"}) << "as without a device";
  send(1, "A@A@E?");
  EXPECT_EQ(leaving(), "E?");
}

TEST_F(DeviceTest, TheKeyOfCommandModeOpensTheWay) {
  call(call::Key{ToggleSimulator{}});
  send(1, "E?");
  EXPECT_EQ(leaving(), "E?");
  call(call::Key{ToggleSimulator{}});
  EXPECT_EQ(send(2, "E?"), " ");
}

TEST_F(DeviceTest, TimeCannotBeChanged) {
  EXPECT_EQ(std::get<call::Refused>(call(call::Pause{})).code, "has_device");
  EXPECT_EQ(std::get<call::Refused>(call(call::SetRate{Rate{2'000'000}})).code, "has_device");
}

TEST_F(DeviceTest, TheStateTellsOfTheDevice) {
  send(1, "A@E?");
  leaving();
  answer("1");
  EXPECT_EQ(cell_.snapshot().device, (DeviceStatus{"/dev/ttyUSB0", true, true, 2, 1}));
}

TEST_F(DeviceTest, RecordsTellWhatWentToTheDeviceAndCameFromIt) {
  using Texts = std::vector<std::string>;
  send(1, "A@E?");
  EXPECT_EQ(explained(), (Texts{"simulator disabled: commands go to the device from now on",
                                "to the device: E?"}));
  leaving();
  answer("-");
  EXPECT_EQ(explained(), Texts{"from the device: E: 13 counts to go"});
  send(1, "E-5\r");
  EXPECT_EQ(explained(), Texts{R"(to the device: E-5\r)"});
  send(1, "A@");
  EXPECT_EQ(explained(), Texts{"simulator enabled: the device gets no command"});
}

TEST_F(DeviceTest, ItsRepliesAreExplainedAsThoseOfASimulatedMark3) {
  send(1, "A@");
  const auto explained_reply = [&](const char* inquiry, const char* reply) {
    send(1, inquiry);
    leaving();
    answer(reply);
    return explained().front();
  };
  EXPECT_EQ(explained_reply("F?", "!"), "from the device: F: 1 count to go");
  EXPECT_EQ(explained_reply("I", "\x5d"), "from the device: microswitches closed: D");
  EXPECT_EQ(explained_reply("J", "\x43"),
            "from the device: microswitches closed: A; input lines high: 5, 6");
  EXPECT_EQ(explained_reply("K", "!"), "from the device: input lines high: 1");
  EXPECT_EQ(explained_reply("K", "z"), "from the device: 7a hex, which is no reply to K");
}

TEST_F(DeviceTest, EventsTellWhoGetsTheCommands) {
  using Texts = std::vector<std::string>;
  send(1, "A@A@");
  EXPECT_EQ(sentences(), (Texts{"the simulator is disabled; commands go to device /dev/ttyUSB0",
                                "the simulator is enabled; device /dev/ttyUSB0 gets no command"}));
  cell_.apply(DeviceLost{"unplugged"}, now_);
  events_.clear();
  call(call::Key{ToggleSimulator{}});
  EXPECT_EQ(sentences(), (Texts{"the simulator is disabled; commands go to device /dev/ttyUSB0, "
                                "which is not there: they are dropped"}));
}

TEST_F(DeviceTest, KnowsWhenItCameAndItsLastCommand) {
  EXPECT_EQ(cell_.device()->opened_tick(), 0);
  EXPECT_EQ(cell_.device()->last(), "");
  cell_.apply(DeviceLost{"unplugged"}, now_);
  EXPECT_EQ(cell_.device()->opened_tick(), std::nullopt);
  pass(70);
  cell_.apply(DeviceOpened{}, now_);
  EXPECT_EQ(cell_.device()->opened_tick(), 70);
  send(1, "A@E+5\rF?");
  EXPECT_EQ(cell_.device()->last(), "F?");
}

// --- The simulation beside the device.

class MirrorTest : public DeviceTest {
 protected:
  MirrorTest() : DeviceTest(true) {}
  Counts count(char label) const {
    return cell_.state().motor(cell_.model().index_of(label)).count;
  }
};

TEST_F(MirrorTest, TheSimulationCarriesOutTheCommandsToo) {
  EXPECT_EQ(send(1, "A@E+5\rE?"), "") << "its reply is discarded";
  EXPECT_EQ(leaving(), "E+5\rE?");
  answer("%");
  EXPECT_EQ(replies(1), "%");
  pass(1000);
  EXPECT_EQ(count('E'), 5);
}

TEST_F(MirrorTest, AStopStopsTheSimulationToo) {
  send(1, "A@E+100\r");
  pass(100);
  EXPECT_FALSE(cell_.is_at_rest());
  call(call::StopDevice{});
  EXPECT_TRUE(cell_.is_at_rest());
}

TEST_F(MirrorTest, CommandsOfTheSimulatorActThereAlone) {
  send(1, "A@E+5\r");
  pass(1000);
  codes();
  EXPECT_EQ(send(1, "A#A$"), "");
  EXPECT_EQ(leaving(), "E+5\r");
  EXPECT_EQ(count('E'), 0);
  EXPECT_EQ(codes(), Codes{"homed"});
}

TEST_F(MirrorTest, CountersThatDifferAndStandStillAreReported) {
  send(1, "A@");
  codes();
  for (int i = 0; i < 4; ++i) {
    send(1, "E?");
    answer("%");
    EXPECT_EQ(replies(1), "%");
    pass(250);
  }
  EXPECT_EQ(codes(), Codes{"mirror_difference"});
}

TEST_F(MirrorTest, ALimitOfTheSimulationLosesIt) {
  send(1, "A@" + std::string("E-100\rE-100\rE-100\rE-100\rE-100\rE-100\r"));
  codes();
  pass(20'000);
  for (int i = 0; i < 12; ++i) send(1, "E-100\r"), pass(2000);
  const Codes found = codes();
  EXPECT_EQ(std::count(found.begin(), found.end(), "mirror_lost"), 1);
  EXPECT_NE(leaving().find("E-100\rE-100\r"), std::string::npos) << "the device goes on";
  call(call::AlignMirror{});
  EXPECT_EQ(count('E'), 0);
  EXPECT_EQ(codes(), (Codes{"switch", "homed", "mirror_aligned"}));
}

TEST_F(DeviceTest, WithoutAMirrorThereIsNothingToAlign) {
  EXPECT_EQ(std::get<call::Refused>(call(call::AlignMirror{})).code, "no_device");
}

}  // namespace
}  // namespace xr3
