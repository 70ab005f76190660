// The client's end of RFC 2217, also against the server's end of this project.
#include "protocol/line/telnet_client.hpp"

#include <gtest/gtest.h>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/telnet.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

SerialSettings settings_of(std::string_view text) { return *parse_serial_settings(text); }

/// The data of bytes from the server; answers are appended.
std::string data_in(TelnetClient& client, std::string_view bytes, std::string& answers) {
  std::string data;
  for (const char byte : bytes) {
    const auto got = client.feed(static_cast<std::uint8_t>(byte), answers);
    if (got) data.push_back(static_cast<char>(*got));
  }
  return data;
}

/// Exchanges bytes until both ends are silent.
void converse(TelnetClient& client, TelnetFilter& server, std::string to_server) {
  for (int turns = 0; !to_server.empty(); ++turns) {
    ASSERT_LT(turns, 10) << "the two ends do not stop answering";
    std::string to_client;
    for (const char byte : to_server) server.feed(static_cast<std::uint8_t>(byte), to_client);
    to_server.clear();
    data_in(client, to_client, to_server);
  }
}

TEST(TelnetClient, AsksFirstAndSetsThePortUpWhenItMay) {
  TelnetClient client(settings_of("9600-7e2"));
  EXPECT_EQ(hexadecimal(client.opening()), "fffb00fffd00fffb03fffd03fffb2c");
  EXPECT_FALSE(client.is_settled());
  std::string answers;
  EXPECT_EQ(data_in(client, "\xff\xfd\x2c", answers), "");
  EXPECT_TRUE(client.has_com_port());
  EXPECT_FALSE(client.is_settled());
  EXPECT_EQ(hexadecimal(answers),
            "fffa2c0100002580fff0fffa2c0207fff0fffa2c0303fff0fffa2c0402fff0fffa2c0501fff0");
}

TEST(TelnetClient, AgreesWithTheServer) {
  for (const auto* text : {"9600-7e2", "115200-8n1-rtscts", "300-5n1.5-xonxoff", "255-8m1"}) {
    TelnetClient client(settings_of(text));
    TelnetFilter server;
    converse(client, server, client.opening());
    EXPECT_TRUE(client.has_com_port());
    EXPECT_TRUE(client.is_settled());
    EXPECT_EQ(text_of(client.settings()), text);
    ASSERT_TRUE(server.settings());
    EXPECT_EQ(text_of(*server.settings()), text);
  }
}

TEST(TelnetClient, KnowsWhatAServerHasSetInstead) {
  TelnetClient client(settings_of("9600-7e2"));
  std::string ignored = client.opening();
  data_in(client, "\xff\xfd\x2c", ignored);
  data_in(client,
          "\xff\xfa\x2c\x65\x00\x00\x25\x80\xff\xf0\xff\xfa\x2c\x66\x08\xff\xf0"
          "\xff\xfa\x2c\x67\x01\xff\xf0\xff\xfa\x2c\x68\x01\xff\xf0\xff\xfa\x2c\x69\x01\xff\xf0"sv,
          ignored);
  EXPECT_TRUE(client.is_settled());
  EXPECT_EQ(text_of(client.settings()), "9600-8n1");
}

TEST(TelnetClient, IsSettledWhenComPortIsRefused) {
  TelnetClient client(settings_of("9600-7e2"));
  std::string answers = client.opening();
  answers.clear();
  EXPECT_EQ(data_in(client, "\xff\xfe\x2c", answers), "");
  EXPECT_EQ(answers, "");
  EXPECT_TRUE(client.is_settled());
  EXPECT_FALSE(client.has_com_port());
}

TEST(TelnetClient, RefusesEcho) {
  TelnetClient client(settings_of("9600-7e2"));
  std::string answers;
  EXPECT_EQ(data_in(client, "a\xff\xfb\x01z", answers), "az");
  EXPECT_EQ(hexadecimal(answers), "fffe01");
}

TEST(TelnetClient, DataIsEightBitClean) {
  std::string sent;
  TelnetClient::encode("a\xff\0z"sv, sent);
  EXPECT_EQ(sent, "a\xff\xff\0z"sv);
  TelnetClient client(settings_of("9600-7e2"));
  std::string answers;
  EXPECT_EQ(data_in(client, sent, answers), "a\xff\0z"sv);
  EXPECT_EQ(answers, "");
}

TEST(TelnetClient, SendsBreaksAndIsSuspended) {
  TelnetClient client(settings_of("9600-7e2"));
  std::string sent = client.opening();
  data_in(client, "\xff\xfd\x2c", sent);
  sent.clear();
  client.append_break(true, sent);
  client.append_break(false, sent);
  EXPECT_EQ(hexadecimal(sent), "fffa2c0505fff0fffa2c0506fff0");
  data_in(client, "\xff\xfa\x2c\x6c\xff\xf0", sent);
  EXPECT_TRUE(client.is_suspended());
  data_in(client, "\xff\xfa\x2c\x6d\xff\xf0", sent);
  EXPECT_FALSE(client.is_suspended());
}

}  // namespace
}  // namespace xr3
