// The requests of a COM-PORT client and their answers (RFC 2217), as codes and values in hex.
#include "protocol/line/com_port.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

struct Answer {
  std::string bytes;  ///< code and value in hex, without IAC SB 44 and IAC SE
  BufferControl control;
};

Answer ask(ComPort& port, std::string_view request) {
  const std::vector<std::uint8_t> bytes(request.begin(), request.end());
  std::string out;
  const BufferControl control = port.handle(bytes, out);
  if (out.empty()) return {"", control};
  EXPECT_TRUE(out.starts_with("\xff\xfa\x2c") && out.ends_with("\xff\xf0")) << hexadecimal(out);
  return {hexadecimal(std::string_view(out).substr(3, out.size() - 5)), control};
}

struct RequestRow {
  const char* what;
  std::string_view request;
  const char* answer;
};

constexpr RequestRow kExchanges[] = {
    {"9600 baud", "\x01\x00\x00\x25\x80"sv, "6500002580"},
    {"any speed", "\x01\x12\x34\x56\x78"sv, "6512345678"},
    {"the speed asked for last", "\x01\x00\x00\x00\x00"sv, "6512345678"},
    {"7 data bits", "\x02\x07"sv, "6607"},
    {"8 data bits", "\x02\x08"sv, "6608"},
    {"which data bits?", "\x02\x00"sv, "6608"},
    {"even parity", "\x03\x03"sv, "6703"},
    {"which parity?", "\x03\x00"sv, "6703"},
    {"2 stop bits", "\x04\x02"sv, "6802"},
    {"1.5 stop bits", "\x04\x03"sv, "6803"},
    {"which stop bits?", "\x04\x00"sv, "6803"},
    {"no flow control", "\x05\x01"sv, "6901"},
    {"hardware flow control", "\x05\x03"sv, "6903"},
    {"which flow control?", "\x05\x00"sv, "6903"},
    {"flow control by DCD", "\x05\x11"sv, "6911"},
    {"flow control by DSR", "\x05\x13"sv, "6913"},
    {"which flow control now?", "\x05\x00"sv, "6913"},
    {"break?", "\x05\x04"sv, "6906"},
    {"break on", "\x05\x05"sv, "6905"},
    {"break now?", "\x05\x04"sv, "6905"},
    {"break off", "\x05\x06"sv, "6906"},
    {"DTR?", "\x05\x07"sv, "6908"},
    {"DTR off", "\x05\x09"sv, "6909"},
    {"DTR now?", "\x05\x07"sv, "6909"},
    {"RTS?", "\x05\x0a"sv, "690b"},
    {"RTS off", "\x05\x0c"sv, "690c"},
    {"RTS now?", "\x05\x0a"sv, "690c"},
    {"flow control of the input?", "\x05\x0d"sv, "690e"},
    {"flow control of the input by DTR", "\x05\x12"sv, "6912"},
    {"flow control of the input now?", "\x05\x0d"sv, "6912"},
    {"the modem state", "\x07"sv, "6bb0"},
    {"a mask of line states", "\x0a\xff"sv, "6effff"},
    {"a mask of modem states", "\x0b\x00"sv, "6f00"},
    {"purge the replies", "\x0c\x01"sv, "7001"},
    {"purge the input", "\x0c\x02"sv, "7002"},
    {"purge both", "\x0c\x03"sv, "7003"},
    {"the name of the server", "\x00"sv, "64787233"},
    {"the name of the client", "\x00pyserial"sv, ""},
    {"suspend", "\x08"sv, ""},
    {"resume", "\x09"sv, ""},
};

TEST(ComPort, AnswersWithTheValueAskedForOrInEffect) {
  ComPort port;
  for (const RequestRow& row : kExchanges)
    EXPECT_EQ(ask(port, row.request).bytes, row.answer) << row.what;
}

TEST(ComPort, DoublesFFInAnAnswer) {
  ComPort port;
  EXPECT_EQ(ask(port, "\x01\x00\xff\xff\x00"sv).bytes, "6500ffffffff00");
  EXPECT_EQ(port.settings().baud, 0xffff00U);
}

TEST(ComPort, IgnoresUnknownRequestsAndWrongLengths) {
  ComPort port;
  for (const std::string_view request :
       {""sv, "\x01"sv, "\x01\x00\x00\x25"sv, "\x01\x00\x00\x25\x80\x00"sv, "\x02"sv,
        "\x02\x07\x07"sv, "\x05"sv, "\x06"sv, "\x06\x00"sv, "\x07\x00"sv, "\x08\x00"sv,
        "\x09\x00"sv, "\x0a"sv, "\x0c"sv, "\x0c\x01\x01"sv, "\x0d"sv, "\x0d\x01"sv, "\x64"sv,
        "\xff\x01"sv}) {
    const Answer answer = ask(port, request);
    EXPECT_EQ(answer.bytes, "") << hexadecimal(request);
    EXPECT_EQ(answer.control, BufferControl::kNone) << hexadecimal(request);
  }
  EXPECT_EQ(port, ComPort());
}

TEST(ComPort, ControlsTheBytesUnderWay) {
  ComPort port;
  EXPECT_EQ(ask(port, "\x08").control, BufferControl::kSuspend);
  EXPECT_EQ(ask(port, "\x09").control, BufferControl::kResume);
  EXPECT_EQ(ask(port, "\x0c\x01").control, BufferControl::kDropReplies);
  EXPECT_EQ(ask(port, "\x0c\x02").control, BufferControl::kDropInput);
  EXPECT_EQ(ask(port, "\x0c\x03").control, BufferControl::kDropBoth);
  EXPECT_EQ(ask(port, "\x07").control, BufferControl::kNone);
}

TEST(ComPort, RemembersTheSettings) {
  ComPort port;
  EXPECT_EQ(text_of(port.settings()), "9600-7e2");
  const std::pair<std::string_view, const char*> steps[] = {
      {"\x01\x00\x01\xc2\x00"sv, "115200-7e2"},
      {"\x02\x08"sv, "115200-8e2"},
      {"\x03\x01"sv, "115200-8n2"},
      {"\x04\x01"sv, "115200-8n1"},
      {"\x05\x03"sv, "115200-8n1-rtscts"},
      {"\x05\x0f"sv, "115200-8n1-rtscts"},
      {"\x05\x02"sv, "115200-8n1-xonxoff"},
      {"\x05\x01"sv, "115200-8n1"},
      {"\x03\x05"sv, "115200-8s1"},
      {"\x04\x03"sv, "115200-8s1.5"}};
  for (const auto& [request, settings] : steps) {
    ask(port, request);
    EXPECT_EQ(text_of(port.settings()), settings) << hexadecimal(request);
  }
}

// RFC 2217 defines no such sizes. The value is answered, but it is no setting.
TEST(ComPort, RemembersOnlyValuesThatMeanSomething) {
  ComPort port;
  EXPECT_EQ(ask(port, "\x02\x09").bytes, "6609");
  EXPECT_EQ(ask(port, "\x02\x04").bytes, "6604");
  EXPECT_EQ(ask(port, "\x03\x06").bytes, "6706");
  EXPECT_EQ(ask(port, "\x04\x04").bytes, "6804");
  EXPECT_EQ(ask(port, "\x05\x14").bytes, "6914");
  EXPECT_EQ(port, ComPort());
}

}  // namespace
}  // namespace xr3
