// The telnet filter: the bytes that reach the controller, the answers to the client, and when a
// line is recognised as telnet.
#include "protocol/line/telnet.hpp"

#include <gtest/gtest.h>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

struct Filtered {
  std::string data;
  std::string answers;
};

Filtered filter_all(TelnetFilter& filter, std::string_view bytes) {
  Filtered filtered;
  for (const char byte : bytes) {
    const auto data = filter.feed(static_cast<std::uint8_t>(byte), filtered.answers);
    if (data) filtered.data.push_back(static_cast<char>(*data));
  }
  return filtered;
}

struct Row {
  const char* what;
  std::string_view bytes;
  std::string_view data;
  std::string_view answers;
  bool is_telnet;
};

constexpr Row kRows[] = {
    {"plain bytes", "E+5\r\n", "E+5\r\n", "", false},
    {"all that is not FF", "\0\x7f\x80\xf0\xfb\xfe"sv, "\0\x7f\x80\xf0\xfb\xfe"sv, "", false},
    {"WILL is refused by DONT", "\xff\xfb\x01", "", "\xff\xfe\x01", true},
    {"DO is refused by WONT", "\xff\xfd\x03", "", "\xff\xfc\x03", true},
    {"WONT gets no answer", "\xff\xfc\x01", "", "", true},
    {"DONT gets no answer", "\xff\xfe\x01", "", "", true},
    {"DO TIMING-MARK is answered", "\xff\xfd\x06", "", "\xff\xfb\x06", true},
    {"WILL TIMING-MARK is refused", "\xff\xfb\x06", "", "\xff\xfe\x06", true},
    {"option 255", "\xff\xfd\xff", "", "\xff\xfc\xff", true},
    {"option 0", "\xff\xfb\0"sv, "", "\xff\xfe\0"sv, true},
    {"binary both ways", "\xff\xfb\0\xff\xfd\0"sv, "", "\xff\xfe\0\xff\xfc\0"sv, true},
    {"Ctrl-C", "E+5\xff\xf4\xff\xfd\x06?", "E+5?", "\xff\xfb\x06", true},
    {"IP alone", "\xff\xf4", "", "", true},
    {"an escaped FF is one FF", "\xff\xff", "\xff", "", false},
    {"SE, NOP, DM, BRK, AO, AYT, EC, EL, GA vanish",
     "a\xff\xf0\xff\xf1\xff\xf2\xff\xf3\xff\xf5\xff\xf6\xff\xf7\xff\xf8\xff\xf9z", "az", "", false},
    {"a lost FF leaves what follows",
     "\xff"
     "E?",
     "E?", "", false},
    {"FF EF loses the FF only", "\xff\xef", "\xef", "", false},
    {"FF at the end waits", "E\xff", "E", "", false},
    {"an option not yet complete", "\xff\xfd", "", "", false},
    {"a subnegotiation vanishes", "a\xff\xfa\x18\x00vt100\xff\xf0z"sv, "az", "", true},
    {"FF FF inside one is data of it", "\xff\xfa\x18\xff\xff\xf0\xff\xf0z", "z", "", true},
    {"another command inside one does not end it", "\xff\xfa\x18\xff\xf1z\xff\xf0z", "z", "", true},
    {"an empty one", "\xff\xfa\xff\xf0z", "z", "", true},
    {"one without an end", "\xff\xfa\x18z", "", "", false},
};

TEST(Telnet, FiltersCommandsAndAnswersThem) {
  for (const Row& row : kRows) {
    TelnetFilter filter;
    const Filtered filtered = filter_all(filter, row.bytes);
    EXPECT_EQ(filtered.data, row.data) << row.what;
    EXPECT_EQ(hexadecimal(filtered.answers), hexadecimal(row.answers)) << row.what;
    EXPECT_EQ(filter.is_telnet(), row.is_telnet) << row.what;
  }
}

TEST(Telnet, RefusesEveryOptionExceptTheTimingMark) {
  for (unsigned option = 0; option < 256; ++option) {
    const char code = static_cast<char>(option);
    TelnetFilter filter;
    const std::string agreed = filter_all(filter, std::string("\xff\xfd") + code).answers;
    EXPECT_EQ(agreed, std::string(option == 6 ? "\xff\xfb" : "\xff\xfc") + code);
    EXPECT_EQ(filter_all(filter, std::string("\xff\xfb") + code).answers,
              std::string("\xff\xfe") + code);
  }
}

TEST(Telnet, AcceptsASubnegotiationOf512Bytes) {
  TelnetFilter filter;
  const std::string bytes = "\xff\xfa" + std::string(512, 'x') + "\xff\xf0";
  EXPECT_EQ(filter_all(filter, bytes + "E?").data, "E?");
  EXPECT_TRUE(filter.is_telnet());
}

TEST(Telnet, AbandonsALongerSubnegotiation) {
  TelnetFilter filter;
  filter_all(filter, "\xff\xfa" + std::string(513, 'x'));
  EXPECT_EQ(filter_all(filter, "\rE?").data, "\rE?");
  EXPECT_FALSE(filter.is_telnet());
}

TEST(Telnet, AbandonsAnUnfinishedSubnegotiationOfEscapes) {
  TelnetFilter filter;
  std::string bytes = "\xff\xfa";
  for (int i = 0; i < 2000; ++i) bytes += "\xff\xff";
  filter_all(filter, bytes);
  EXPECT_EQ(filter_all(filter, "\rE?").data, "\rE?");
}

TEST(Telnet, DoublesFFInRepliesOnlyForTelnetClients) {
  const std::pair<std::string_view, std::string_view> replies[] = {
      {"R", "R"},
      {"\xff", "\xff\xff"},
      {"a\xff\xff\x01", "a\xff\xff\xff\xff\x01"},
      {"\xf6", "\xf6"}};
  for (const auto& [reply, doubled] : replies) {
    TelnetFilter filter;
    std::string raw;
    filter.encode(reply, raw);
    EXPECT_EQ(raw, reply);
    filter_all(filter, "\xff\xfd\x03");
    std::string telnet;
    filter.encode(reply, telnet);
    EXPECT_EQ(telnet, doubled);
  }
}

TEST(Telnet, TheDivisionOfTheInputDoesNotMatter) {
  std::string bytes;
  std::string data;
  std::string answers;
  for (const Row& row : kRows) {
    const bool is_whole = row.what != "FF at the end waits"sv &&
                          row.what != "an option not yet complete"sv &&
                          row.what != "one without an end"sv;
    if (!is_whole) continue;
    bytes += row.bytes;
    data += row.data;
    answers += row.answers;
  }
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    TelnetFilter filter;
    Filtered filtered = filter_all(filter, std::string_view(bytes).substr(0, cut));
    TelnetFilter copy = filter;
    const Filtered rest = filter_all(copy, std::string_view(bytes).substr(cut));
    EXPECT_EQ(filtered.data + rest.data, data) << cut;
    EXPECT_EQ(filtered.answers + rest.answers, answers) << cut;
  }
}

}  // namespace
}  // namespace xr3
