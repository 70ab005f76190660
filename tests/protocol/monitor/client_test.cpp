// A client of the monitor port, in memory: protocol detection by the first byte, splitting into
// lines, and the replies, for every division of the input.
#include "protocol/monitor/client.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/monitor/lines.hpp"
#include "protocol/monitor/opening.hpp"

namespace xr3::monitor {
namespace {

/// What a transport does with the lines of a client, up to the next request to execute.
std::optional<Request> next_request(Lines& lines, Client& client) {
  while (!client.has_ended() && !client.is_full()) {
    const auto line = lines.next();
    if (!line) break;
    if (auto request = client.take(*line)) return request;
  }
  if (!client.is_full() && lines.fault() != LineFault::kNone && !client.has_ended())
    client.end(lines.fault());
  return std::nullopt;
}

/// A connection without a network: pings are answered, calls are counted.
class Pipe {
 public:
  void send(std::string_view bytes) {
    if (opening_.tongue() == Tongue::kUndecided) bytes.remove_prefix(opening_.take(bytes));
    if (opening_.tongue() == Tongue::kNotJson) client_.end(Bye::kNotJson);
    if (opening_.tongue() != Tongue::kLines) return;
    lines_.take(bytes);
    serve();
  }
  void end() {
    lines_.end();
    serve();
  }
  Tongue tongue() const { return opening_.tongue(); }
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

  Opening opening_;
  Lines lines_;
  Client client_{{"main"}};
  int calls_ = 0;
};

std::string ping(int id) { return R"({"op":"ping","id":)" + std::to_string(id) + "}"; }
std::string pong_line(int id) { return R"({"op":"pong","id":)" + std::to_string(id) + "}\n"; }
std::string not_json() { return *bye(Bye::kNotJson) + "\n"; }

Tongue tongue_of(std::string_view bytes, bool after_silence = false) {
  Opening opening;
  if (after_silence) opening.settle_for_lines();
  for (const char byte : bytes) opening.take({&byte, 1});
  return opening.tongue();
}

const std::string kMark = "\xEF\xBB\xBF";

TEST(MonitorOpening, TheFirstByteDecides) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string bytes(1, static_cast<char>(byte));
    Tongue expected = Tongue::kNotJson;
    if (bytes == "{") expected = Tongue::kLines;
    if (byte >= 'A' && byte <= 'Z') expected = Tongue::kHttp;
    if (byte == 0x16) expected = Tongue::kTls;
    if (bytes == " " || bytes == "\t" || bytes == "\r" || bytes == "\n" || byte == 0xEF)
      expected = Tongue::kUndecided;
    EXPECT_EQ(tongue_of(bytes), expected) << byte;
    if (expected == Tongue::kHttp || expected == Tongue::kTls) expected = Tongue::kNotJson;
    EXPECT_EQ(tongue_of(bytes, true), expected) << byte;
  }
}

TEST(MonitorOpening, BlanksAndOneMarkAreSkipped) {
  EXPECT_EQ(tongue_of("\r\n \t{"), Tongue::kLines);
  EXPECT_EQ(tongue_of("\r\nGET /"), Tongue::kHttp);
  EXPECT_EQ(tongue_of(kMark), Tongue::kUndecided);
  EXPECT_EQ(tongue_of(kMark + "{"), Tongue::kLines);
  EXPECT_EQ(tongue_of(kMark + "GET /"), Tongue::kHttp);
  EXPECT_EQ(tongue_of(" \n" + kMark + "\n {"), Tongue::kLines);
  EXPECT_EQ(tongue_of(kMark + kMark + "{"), Tongue::kNotJson);
  EXPECT_EQ(tongue_of("\xEF{"), Tongue::kNotJson);
  EXPECT_EQ(tongue_of("\xEF\xBB {"), Tongue::kNotJson);
  EXPECT_EQ(tongue_of("\xBB\xBF{"), Tongue::kNotJson);
}

TEST(MonitorOpening, SkipsNoMoreThanItMust) {
  Opening opening;
  EXPECT_EQ(opening.take(" \r\n"), 3U);
  EXPECT_EQ(opening.take(kMark + "  {  }"), 5U);
  EXPECT_EQ(opening.take("   "), 0U);
}

TEST(MonitorLines, EndsOfLines) {
  Lines lines;
  lines.take("{1}\n{2}\r\n\n \r\n\t\n  {3}\n{4");
  EXPECT_EQ(lines.next(), "{1}");
  EXPECT_EQ(lines.next(), "{2}");
  EXPECT_EQ(lines.next(), "{3}");
  EXPECT_EQ(lines.next(), std::nullopt);
  lines.take("}");
  EXPECT_EQ(lines.next(), std::nullopt);
  lines.end();
  EXPECT_EQ(lines.next(), "{4}");
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.fault(), LineFault::kNone);
}

TEST(MonitorLines, WhatIsNoObjectEndsThemAtItsFirstByte) {
  Lines lines;
  lines.take("{1}\nG");
  EXPECT_EQ(lines.next(), "{1}");
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.fault(), LineFault::kNotJson);
  lines.take("\n{2}\n");
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(MonitorLines, LengthIsBoundedByTheByte) {
  const std::string longest = "{" + std::string(kMostMessageBytes - 1, 'x');
  for (const std::string end : {"\n", "\r\n", ""}) {
    for (const bool is_too_long : {false, true}) {
      for (const std::size_t chunk : {std::size_t{1} << 20, std::size_t{8192}, std::size_t{1}}) {
        const std::string text = longest + (is_too_long ? "y" : "") + end;
        Lines lines;
        std::optional<std::string_view> line;
        for (std::size_t i = 0; i < text.size() && !line; i += chunk) {
          lines.take(std::string_view(text).substr(i, chunk));
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

TEST(MonitorClient, AnswersInOrder) {
  Pipe pipe;
  pipe.send(ping(1) + "\n" + ping(2) + "\r\n{\n" + ping(3));
  pipe.end();
  const std::string broken = *result(std::get<RequestError>(read_request("{", {"main"}))) + "\n";
  EXPECT_EQ(pipe.received(), pong_line(1) + pong_line(2) + broken + pong_line(3));
  EXPECT_FALSE(pipe.has_ended());
}

TEST(MonitorClient, NothingBehindALineThatIsNoJsonActs) {
  const std::string call = "{\"op\":\"call\",\"fn\":\"home\"}\n";
  for (const std::string stranger :
       {"POST / HTTP/1.1\r\n", "help\n", "[1]\n", "\"x\"\n", "\xEF\xBB\xBF{}\n"}) {
    Pipe pipe;
    pipe.send(call + stranger + call);
    pipe.send(call);
    pipe.end();
    EXPECT_EQ(pipe.calls(), 1) << stranger;
    EXPECT_EQ(pipe.received(), "{\"op\":\"pong\",\"id\":null}\n" + not_json()) << stranger;
  }
}

TEST(MonitorClient, AStrangersFirstByteIsEnough) {
  Pipe pipe;
  pipe.send("h");
  EXPECT_EQ(pipe.received(), not_json());
  pipe.send("\n{\"op\":\"call\",\"fn\":\"home\"}\n");
  EXPECT_EQ(pipe.calls(), 0);
  EXPECT_EQ(pipe.received(), "");
}

TEST(MonitorClient, ALineTooLongIsToldAndEndsIt) {
  Pipe pipe;
  pipe.send(ping(1) + "\n{" + std::string(kMostMessageBytes, 'x'));
  const std::string told = pipe.received();
  EXPECT_EQ(
      told.find(pong_line(1) + R"({"op":"result","id":null,"ok":false,"error":{"code":"too_long")"),
      0U);
  EXPECT_TRUE(told.ends_with(*bye(Bye::kTooLong) + "\n"));
  pipe.send("\n" + ping(2) + "\n");
  EXPECT_TRUE(pipe.has_ended());
  EXPECT_EQ(pipe.received(), "");
}

TEST(MonitorClient, CutAnywhereItIsTheSame) {
  const std::string text =
      "\r\n" + kMark + " " + ping(1) + "\r\n\r\n" + ping(2) + "\n{\"op\":\"x\"}\n{]\n " + ping(3) +
      "\n{\"op\":\"call\",\"fn\":\"step\",\"args\":{}}\n" + ping(4) + "\nhelp\n" + ping(5) + "\n";
  Pipe whole;
  whole.send(text);
  const std::string expected = whole.received();
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

TEST(MonitorClient, AFullLaneStopsRequests) {
  Lines lines;
  Client client({"main"});
  for (int i = 0; i < 300; ++i) lines.take(ping(i) + "\n");
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

TEST(MonitorClient, ErrorsFillTheLaneToo) {
  Lines lines;
  Client client({"main"});
  for (int i = 0; i < 300; ++i) lines.take("{]\n");
  lines.take("help\n");
  EXPECT_FALSE(next_request(lines, client));
  EXPECT_TRUE(client.is_full());
  EXPECT_FALSE(client.has_ended());
  int messages = 0;
  while (client.next_output(0)) ++messages;
  EXPECT_EQ(messages, 256);
  EXPECT_FALSE(next_request(lines, client));
  EXPECT_TRUE(client.has_ended());
}

TEST(MonitorClient, BytesFillTheLaneToo) {
  Client client({"main"});
  client.send(std::make_shared<const std::string>(Client::kMostAnswerBytes, 'x'));
  EXPECT_TRUE(client.is_full());
  client.end(Bye::kShutdown);  // `bye` is always queued
  client.send(pong({}));
  EXPECT_NE(client.next_output(0), nullptr);
  EXPECT_EQ(*client.next_output(0), *bye(Bye::kShutdown));
  EXPECT_EQ(client.next_output(0), nullptr);
}

}  // namespace
}  // namespace xr3::monitor
