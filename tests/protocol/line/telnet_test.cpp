// The telnet filter: the bytes that reach the controller, the answers to the client, and when a
// line is recognised as telnet or RFC 2217.
#include "protocol/line/telnet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

struct Filtered {
  std::string data;
  std::string answers;
  std::vector<BufferControl> controls;
};

Filtered filter_all(TelnetFilter& filter, std::string_view bytes) {
  Filtered filtered;
  for (const char byte : bytes) {
    const bool is_data = filter.is_data(static_cast<std::uint8_t>(byte));
    const TelnetInput input = filter.feed(static_cast<std::uint8_t>(byte), filtered.answers);
    EXPECT_EQ(input.data.has_value(), is_data);
    if (input.data) filtered.data.push_back(static_cast<char>(*input.data));
    if (input.control != BufferControl::kNone) filtered.controls.push_back(input.control);
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

constexpr Row kTelnetRows[] = {
    {"plain bytes", "E+5\r\n", "E+5\r\n", "", false},
    {"all that is not FF", "\0\x7f\x80\xf0\xfb\xfe"sv, "\0\x7f\x80\xf0\xfb\xfe"sv, "", false},
    {"WILL is refused by DONT", "\xff\xfb\x01", "", "\xff\xfe\x01", true},
    {"DO is refused by WONT", "\xff\xfd\x01", "", "\xff\xfc\x01", true},
    {"SGA is accepted", "\xff\xfd\x03\xff\xfb\x03", "", "\xff\xfb\x03\xff\xfd\x03", true},
    {"WONT gets no answer", "\xff\xfc\x01", "", "", true},
    {"DONT gets no answer", "\xff\xfe\x01", "", "", true},
    {"DO TIMING-MARK is answered", "\xff\xfd\x06", "", "\xff\xfb\x06", true},
    {"WILL TIMING-MARK is refused", "\xff\xfb\x06", "", "\xff\xfe\x06", true},
    {"option 255", "\xff\xfd\xff", "", "\xff\xfc\xff", true},
    {"binary both ways", "\xff\xfb\0\xff\xfd\0"sv, "", "\xff\xfd\0\xff\xfb\0"sv, true},
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
  for (const Row& row : kTelnetRows) {
    TelnetFilter filter;
    const Filtered filtered = filter_all(filter, row.bytes);
    EXPECT_EQ(filtered.data, row.data) << row.what;
    EXPECT_EQ(hexadecimal(filtered.answers), hexadecimal(row.answers)) << row.what;
    EXPECT_EQ(filter.is_telnet(), row.is_telnet) << row.what;
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
    filter_all(filter, "\xff\xfd\x01");
    std::string telnet;
    filter.encode(reply, telnet);
    EXPECT_EQ(telnet, doubled);
  }
}

TEST(Telnet, TheDivisionOfTheInputDoesNotMatter) {
  std::string bytes;
  for (const Row& row : kTelnetRows) bytes += row.bytes;
  bytes += "\xff\xf0\xff\xfb\x2c\xff\xfa\x2c\x01\xff\xff\x00\x01\x02\xff\xf0"sv;
  TelnetFilter whole;
  const Filtered all = filter_all(whole, bytes);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    TelnetFilter filter;
    Filtered filtered = filter_all(filter, std::string_view(bytes).substr(0, cut));
    TelnetFilter copy = filter;
    const Filtered rest = filter_all(copy, std::string_view(bytes).substr(cut));
    EXPECT_EQ(filtered.data + rest.data, all.data) << cut;
    EXPECT_EQ(filtered.answers + rest.answers, all.answers) << cut;
    EXPECT_EQ(copy, whole) << cut;
  }
}

// --- RFC 2217.

/// The bytes of a text in hex; blanks and bars do not matter.
std::string bytes_of(std::string_view hex) {
  std::string digits;
  std::ranges::copy_if(hex, std::back_inserter(digits),
                       [](char c) { return c != ' ' && c != '|'; });
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// The requests of a client, each as `01 00 00 25 80`, in subnegotiations of COM-PORT.
std::string requests_of(std::string_view hex) {
  std::string bytes;
  while (!hex.empty()) {
    const std::string_view request = hex.substr(0, hex.find('|'));
    bytes += "\xff\xfa\x2c" + bytes_of(request) + "\xff\xf0";
    hex.remove_prefix(std::min(hex.size(), request.size() + 1));
  }
  return bytes;
}

/// A line on which COM-PORT has been negotiated.
TelnetFilter with_com_port() {
  TelnetFilter filter;
  filter_all(filter, "\xff\xfb\x2c");
  return filter;
}

TEST(Rfc2217, PyserialOpensAPort) {
  TelnetFilter line;
  EXPECT_EQ(filter_all(line, bytes_of("ff fd 01|ff fb 03|ff fd 03|ff fd 2c|ff fb 2c")).answers,
            bytes_of("ff fc 01|ff fd 03|ff fb 03|ff fb 2c|ff fd 2c|ff fa 2c 6b b0 ff f0"));
  EXPECT_EQ(filter_all(line, requests_of("01 00 00 25 80|02 07|03 03|04 02")).answers,
            requests_of("65 00 00 25 80|66 07|67 03|68 02"));
  EXPECT_EQ(filter_all(line, requests_of("05 01|05 08|05 0b|0c 01|0c 02")).answers,
            requests_of("69 01|69 08|69 0b|70 01|70 02"));
  ASSERT_TRUE(line.settings());
  EXPECT_EQ(text_of(*line.settings()), "9600-7e2");
}

TEST(Rfc2217, TheModemStateIsSentOnceAndWhenAskedFor) {
  TelnetFilter line;
  EXPECT_EQ(filter_all(line, bytes_of("ff fd 2c")).answers, bytes_of("ff fb 2c"));
  EXPECT_EQ(filter_all(line, bytes_of("ff fb 2c")).answers,
            bytes_of("ff fd 2c|ff fa 2c 6b b0 ff f0"));
  EXPECT_EQ(filter_all(line, bytes_of("ff fb 2c")).answers, "");
  EXPECT_EQ(filter_all(line, requests_of("07")).answers, requests_of("6b b0"));
}

TEST(Rfc2217, BytesFFAreDoubledBothWays) {
  TelnetFilter line = with_com_port();
  EXPECT_EQ(filter_all(line, bytes_of("ff fa 2c 01 ff ff ff ff 00 ff ff ff f0")).answers,
            bytes_of("ff fa 2c 65 ff ff ff ff 00 ff ff ff f0"));
  EXPECT_EQ(line.settings()->baud, 0xffff00ffU);
}

TEST(Rfc2217, WithoutTheOptionRequestsGetNoAnswer) {
  TelnetFilter line;
  EXPECT_EQ(filter_all(line, requests_of("07|01 00 00 25 80")).answers, "");
  EXPECT_FALSE(line.settings());
  EXPECT_FALSE(line.has_com_port());
  EXPECT_TRUE(line.is_telnet());
}

TEST(Rfc2217, EitherSideMayHaveTheOption) {
  TelnetFilter line;
  filter_all(line, bytes_of("ff fd 2c"));
  EXPECT_EQ(filter_all(line, requests_of("07")).answers, requests_of("6b b0"));
  EXPECT_TRUE(line.has_com_port());
}

TEST(Rfc2217, OtherSubnegotiationsAreIgnored) {
  TelnetFilter line = with_com_port();
  EXPECT_EQ(
      filter_all(line, bytes_of("ff fa ff f0|ff fa 2c ff f0|ff fa 1f 00 50 00 18 ff f0")).answers,
      "");
  EXPECT_EQ(filter_all(line, bytes_of("ff fa 2c 01 00 00 25 80 00 00 00 ff f0")).answers, "");
  EXPECT_EQ(text_of(*line.settings()), "9600-7e2");
}

TEST(Rfc2217, SuspendsAndResumesReplies) {
  TelnetFilter line = with_com_port();
  using enum BufferControl;
  EXPECT_EQ(filter_all(line, requests_of("08|09|0c 01|0c 02|0c 03")).controls,
            (std::vector{kSuspend, kResume, kDropReplies, kDropInput, kDropBoth}));
}

TEST(Rfc2217, TheEndOfTheOptionResumesReplies) {
  TelnetFilter line = with_com_port();
  filter_all(line, bytes_of("ff fd 2c"));
  EXPECT_EQ(filter_all(line, bytes_of("ff fc 2c")).controls.size(), 0U) << "one side is still on";
  const Filtered off = filter_all(line, bytes_of("ff fe 2c"));
  EXPECT_EQ(off.answers, bytes_of("ff fc 2c"));
  EXPECT_EQ(off.controls, std::vector{BufferControl::kResume});
  EXPECT_FALSE(line.settings());
}

}  // namespace
}  // namespace xr3
