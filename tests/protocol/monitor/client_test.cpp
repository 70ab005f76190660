// A client of the monitor port, in memory: protocol detection by the first byte, splitting into
// lines, and the replies, for every division of the input.
#include "protocol/monitor/client.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

/// Handles the lines of a client as a transport does, up to the next request to execute.
std::optional<Request> next_request(LineSplitter& lines, Client& client) {
  while (!client.has_ended() && !client.is_full()) {
    const auto line = lines.next();
    if (!line) break;
    if (auto request = client.handle(*line)) return request;
  }
  if (!client.is_full() && lines.fault() != LineFault::kNone && !client.has_ended())
    client.end(lines.fault());
  return std::nullopt;
}

/// A connection without a network: pings are answered, calls are counted.
class Pipe {
 public:
  void send(std::string_view bytes) {
    if (detector_.protocol() == Protocol::kUndecided) bytes.remove_prefix(detector_.feed(bytes));
    if (detector_.protocol() == Protocol::kNotJson) client_.end(CloseReason::kNotJson);
    if (detector_.protocol() != Protocol::kLines) return;
    lines_.feed(bytes);
    serve();
  }
  void end() {
    lines_.end();
    serve();
  }
  Protocol protocol() const { return detector_.protocol(); }
  int calls() const { return calls_; }
  bool has_ended() const { return client_.has_ended(); }
  std::string received() {
    std::string all;
    while (const Message message = client_.next_output(0)) all += *message + "\n";
    return all;
  }

 private:
  void serve() {
    while (const auto request = next_request(lines_, client_)) {
      if (std::holds_alternative<CallRequest>(request->what)) ++calls_;
      client_.send(pong(request->id));
    }
  }

  ProtocolDetector detector_;
  LineSplitter lines_;
  Client client_;
  int calls_ = 0;
};

std::string ping(int id) { return R"({"op":"ping","id":)" + std::to_string(id) + "}"; }
std::string pong_line(int id) { return R"({"op":"pong","id":)" + std::to_string(id) + "}\n"; }
std::string not_json() { return *bye(CloseReason::kNotJson) + "\n"; }

Protocol protocol_of(std::string_view bytes, bool after_silence = false) {
  ProtocolDetector detector;
  if (after_silence) detector.settle_for_lines();
  for (const char byte : bytes) detector.feed({&byte, 1});
  return detector.protocol();
}

const std::string kMark = "\xEF\xBB\xBF";

TEST(MonitorOpening, TheFirstByteSelectsTheProtocol) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string bytes(1, static_cast<char>(byte));
    Protocol expected = Protocol::kNotJson;
    if (bytes == "{") expected = Protocol::kLines;
    if (byte >= 'A' && byte <= 'Z') expected = Protocol::kHttp;
    if (byte == 0x16) expected = Protocol::kTls;
    if (bytes == " " || bytes == "\t" || bytes == "\r" || bytes == "\n" || byte == 0xEF)
      expected = Protocol::kUndecided;
    EXPECT_EQ(protocol_of(bytes), expected) << byte;
    if (expected == Protocol::kHttp || expected == Protocol::kTls) expected = Protocol::kNotJson;
    EXPECT_EQ(protocol_of(bytes, true), expected) << byte;
  }
}

TEST(MonitorOpening, SkipsBlanksAndOneByteOrderMark) {
  EXPECT_EQ(protocol_of("\r\n \t{"), Protocol::kLines);
  EXPECT_EQ(protocol_of("\r\nGET /"), Protocol::kHttp);
  EXPECT_EQ(protocol_of(kMark), Protocol::kUndecided);
  EXPECT_EQ(protocol_of(kMark + "{"), Protocol::kLines);
  EXPECT_EQ(protocol_of(kMark + "GET /"), Protocol::kHttp);
  EXPECT_EQ(protocol_of(" \n" + kMark + "\n {"), Protocol::kLines);
  EXPECT_EQ(protocol_of(kMark + kMark + "{"), Protocol::kNotJson);
  EXPECT_EQ(protocol_of("\xEF{"), Protocol::kNotJson);
  EXPECT_EQ(protocol_of("\xEF\xBB {"), Protocol::kNotJson);
  EXPECT_EQ(protocol_of("\xBB\xBF{"), Protocol::kNotJson);
}

TEST(MonitorOpening, StopsSkippingAtTheFirstByte) {
  ProtocolDetector detector;
  EXPECT_EQ(detector.feed(" \r\n"), 3U);
  EXPECT_EQ(detector.feed(kMark + "  {  }"), 5U);
  EXPECT_EQ(detector.feed("   "), 0U);
}

TEST(MonitorLines, AcceptsBothLineEnds) {
  LineSplitter lines;
  lines.feed("{1}\n{2}\r\n\n \r\n\t\n  {3}\n{4");
  EXPECT_EQ(lines.next(), "{1}");
  EXPECT_EQ(lines.next(), "{2}");
  EXPECT_EQ(lines.next(), "{3}");
  EXPECT_EQ(lines.next(), std::nullopt);
  lines.feed("}");
  EXPECT_EQ(lines.next(), std::nullopt);
  lines.end();
  EXPECT_EQ(lines.next(), "{4}");
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.fault(), LineFault::kNone);
}

TEST(MonitorLines, AnInvalidFirstByteEndsTheInput) {
  LineSplitter lines;
  lines.feed("{1}\nG");
  EXPECT_EQ(lines.next(), "{1}");
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.fault(), LineFault::kNotJson);
  lines.feed("\n{2}\n");
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(MonitorLines, TheMaximumLengthIsExact) {
  const std::string longest = "{" + std::string(kMaxMessageBytes - 1, 'x');
  for (const std::string end : {"\n", "\r\n", ""}) {
    for (const bool is_too_long : {false, true}) {
      for (const std::size_t chunk : {std::size_t{1} << 20, std::size_t{8192}, std::size_t{1}}) {
        const std::string text = longest + (is_too_long ? "y" : "") + end;
        LineSplitter lines;
        std::optional<std::string_view> line;
        for (std::size_t i = 0; i < text.size() && !line; i += chunk) {
          lines.feed(std::string_view(text).substr(i, chunk));
          line = lines.next();
        }
        if (end.empty()) lines.end();
        if (!line) line = lines.next();
        EXPECT_EQ(line.has_value(), !is_too_long) << end.size() << " " << chunk;
        EXPECT_EQ(lines.fault(), is_too_long ? LineFault::kTooLong : LineFault::kNone);
      }
    }
  }
}

TEST(MonitorClient, RepliesInOrder) {
  Pipe pipe;
  pipe.send(ping(1) + "\n" + ping(2) + "\r\n{\n" + ping(3));
  pipe.end();
  const std::string broken = *result(std::get<RequestError>(read_request("{"))) + "\n";
  EXPECT_EQ(pipe.received(), pong_line(1) + pong_line(2) + broken + pong_line(3));
  EXPECT_FALSE(pipe.has_ended());
}

TEST(MonitorClient, IgnoresEverythingAfterALineThatIsNotJson) {
  const std::string call = "{\"op\":\"call\",\"fn\":\"home\"}\n";
  for (const std::string greeting :
       {"POST / HTTP/1.1\r\n", "help\n", "[1]\n", "\"x\"\n", "\xEF\xBB\xBF{}\n"}) {
    Pipe pipe;
    pipe.send(call + greeting + call);
    pipe.send(call);
    pipe.end();
    EXPECT_EQ(pipe.calls(), 1) << greeting;
    EXPECT_EQ(pipe.received(), "{\"op\":\"pong\",\"id\":null}\n" + not_json()) << greeting;
  }
}

TEST(MonitorClient, AWrongFirstByteEndsTheConnection) {
  Pipe pipe;
  pipe.send("h");
  EXPECT_EQ(pipe.received(), not_json());
  pipe.send("\n{\"op\":\"call\",\"fn\":\"home\"}\n");
  EXPECT_EQ(pipe.calls(), 0);
  EXPECT_EQ(pipe.received(), "");
}

TEST(MonitorClient, ALineThatIsTooLongGetsAnErrorAndABye) {
  Pipe pipe;
  pipe.send(ping(1) + "\n{" + std::string(kMaxMessageBytes, 'x'));
  const std::string received = pipe.received();
  EXPECT_EQ(received.find(pong_line(1) +
                          R"({"op":"result","id":null,"ok":false,"error":{"code":"too_long")"),
            0U);
  EXPECT_TRUE(received.ends_with(*bye(CloseReason::kTooLong) + "\n"));
  pipe.send("\n" + ping(2) + "\n");
  EXPECT_TRUE(pipe.has_ended());
  EXPECT_EQ(pipe.received(), "");
}

TEST(MonitorClient, TheDivisionOfTheInputDoesNotMatter) {
  const std::string text =
      "\r\n" + kMark + " " + ping(1) + "\r\n\r\n" + ping(2) + "\n{\"op\":\"x\"}\n{]\n " + ping(3) +
      "\n{\"op\":\"call\",\"fn\":\"step\",\"args\":{}}\n" + ping(4) + "\nhelp\n" + ping(5) + "\n";
  Pipe undivided;
  undivided.send(text);
  const std::string expected = undivided.received();
  EXPECT_NE(expected.find(pong_line(4)), std::string::npos);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Pipe pipe;
    pipe.send(text.substr(0, cut));
    pipe.send(text.substr(cut));
    EXPECT_EQ(pipe.received(), expected) << cut;
  }
  Pipe drops;
  for (const char byte : text) drops.send({&byte, 1});
  EXPECT_EQ(drops.received(), expected);
}

TEST(MonitorClient, AFullQueueStopsRequests) {
  LineSplitter lines;
  Client client;
  for (int i = 0; i < 300; ++i) lines.feed(ping(i) + "\n");
  int answered = 0;
  const auto serve = [&] {
    while (const auto request = next_request(lines, client)) {
      client.send(pong(request->id));
      ++answered;
    }
  };
  serve();
  EXPECT_EQ(answered, 256);
  EXPECT_TRUE(client.is_full());
  EXPECT_EQ(*client.next_output(0) + "\n", pong_line(0));
  serve();
  EXPECT_EQ(answered, 257);
  while (client.next_output(0)) {
  }
  serve();
  EXPECT_EQ(answered, 300);
}

TEST(MonitorClient, ErrorsFillTheQueue) {
  LineSplitter lines;
  Client client;
  for (int i = 0; i < 300; ++i) lines.feed("{]\n");
  lines.feed("help\n");
  EXPECT_FALSE(next_request(lines, client));
  EXPECT_TRUE(client.is_full());
  EXPECT_FALSE(client.has_ended());
  int messages = 0;
  while (client.next_output(0)) ++messages;
  EXPECT_EQ(messages, 256);
  EXPECT_FALSE(next_request(lines, client));
  EXPECT_TRUE(client.has_ended());
}

TEST(MonitorClient, BytesFillTheQueue) {
  Client client;
  client.send(std::make_shared<const std::string>(Client::kMaxAnswerBytes, 'x'));
  EXPECT_TRUE(client.is_full());
  client.end(CloseReason::kShutdown);  // `bye` is always queued
  client.send(pong({}));
  EXPECT_NE(client.next_output(0), nullptr);
  EXPECT_EQ(*client.next_output(0), *bye(CloseReason::kShutdown));
  EXPECT_EQ(client.next_output(0), nullptr);
}

}  // namespace
}  // namespace xr3::monitor
