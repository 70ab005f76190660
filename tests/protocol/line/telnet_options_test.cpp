// The negotiation of telnet options (RFC 1143): what is accepted, and that only changes are
// answered.
#include "protocol/line/telnet_options.hpp"

#include <gtest/gtest.h>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/telnet_codes.hpp"

namespace xr3 {
namespace {

using enum TelnetOptions::Side;
using std::string_view_literals::operator""sv;

/// Negotiates one step after another: `step` has a verb and an option for each.
std::string answers_to(TelnetOptions& options, std::string_view steps) {
  std::string answers;
  for (std::size_t i = 0; i + 1 < steps.size(); i += 2) {
    options.negotiate(static_cast<std::uint8_t>(steps[i]), static_cast<std::uint8_t>(steps[i + 1]),
                      answers);
  }
  return hexadecimal(answers);
}

std::string answer_to(TelnetOptions& options, std::uint8_t verb, unsigned option) {
  std::string answer;
  options.negotiate(verb, static_cast<std::uint8_t>(option), answer);
  return hexadecimal(answer);
}

std::string sent(std::uint8_t verb, unsigned option) {
  return hexadecimal(std::string{'\xff', static_cast<char>(verb), static_cast<char>(option)});
}

TEST(TelnetOptions, AcceptBinaryGoAheadAndComPortAtEitherSide) {
  for (unsigned option = 0; option < 256; ++option) {
    const bool is_accepted = option == 0 || option == 3 || option == 44;
    TelnetOptions options;
    const std::uint8_t code = static_cast<std::uint8_t>(option);
    EXPECT_EQ(answer_to(options, telnet::kWill, option),
              sent(is_accepted ? telnet::kDo : telnet::kDont, option));
    EXPECT_EQ(options.is_on(kPeer, code), is_accepted) << option;
    EXPECT_FALSE(options.is_on(kOwn, code)) << option;
    const bool is_answered = is_accepted || option == telnet::kTimingMark;
    EXPECT_EQ(answer_to(options, telnet::kDo, option),
              sent(is_answered ? telnet::kWill : telnet::kWont, option));
    EXPECT_EQ(options.is_on(kOwn, code), is_accepted) << option;
  }
}

TEST(TelnetOptions, AnswerOnlyChanges) {
  TelnetOptions options;
  EXPECT_EQ(answers_to(options, "\xfb\x03"), "fffd03") << "WILL SGA: DO";
  EXPECT_EQ(answers_to(options, "\xfb\x03\xfb\x03"), "") << "it is on already";
  EXPECT_EQ(answers_to(options, "\xfd\x03"), "fffb03") << "the other side is of its own";
  EXPECT_EQ(answers_to(options, "\xfc\x03"), "fffe03") << "WONT SGA: DONT";
  EXPECT_EQ(answers_to(options, "\xfc\x03"), "") << "it is off already";
  EXPECT_TRUE(options.is_on(kOwn, 3));
  EXPECT_EQ(answers_to(options, "\xfe\x03"), "fffc03") << "DONT SGA: WONT";
  EXPECT_EQ(answers_to(options, "\xfe\x03\xfc\x2c\xfe\x2c\xfc\x00\xfe\x00"sv), "");
  EXPECT_EQ(options, TelnetOptions());
}

TEST(TelnetOptions, RefuseAsOftenAsTheyAreAsked) {
  TelnetOptions options;
  EXPECT_EQ(answers_to(options, "\xfd\x01\xfd\x01\xfb\x1f"), "fffc01fffc01fffe1f");
  EXPECT_EQ(answers_to(options, "\xfe\x01\xfc\x1f"), "") << "they are off";
}

TEST(TelnetOptions, TheTimingMarkHasNoState) {
  TelnetOptions options;
  EXPECT_EQ(answers_to(options, "\xfd\x06\xfd\x06\xfb\x06\xfe\x06"), "fffb06fffb06fffe06");
  EXPECT_EQ(options, TelnetOptions());
}

TEST(TelnetOptions, TheConsentToAQuestionIsNotAnswered) {
  TelnetOptions options;
  std::string asked;
  options.ask(kOwn, telnet::kComPort, asked);
  options.ask(kPeer, telnet::kBinary, asked);
  EXPECT_EQ(hexadecimal(asked), "fffb2cfffd00");
  EXPECT_TRUE(options.is_asked(kOwn, telnet::kComPort));
  EXPECT_FALSE(options.is_on(kOwn, telnet::kComPort));
  EXPECT_EQ(answers_to(options, "\xfd\x2c"), "") << "DO COM-PORT";
  EXPECT_TRUE(options.is_on(kOwn, telnet::kComPort));
  EXPECT_FALSE(options.is_asked(kOwn, telnet::kComPort));
  EXPECT_EQ(answers_to(options, "\xfc\x00"sv), "") << "WONT BINARY";
  EXPECT_FALSE(options.is_on(kPeer, telnet::kBinary));
  EXPECT_FALSE(options.is_asked(kPeer, telnet::kBinary));
  EXPECT_EQ(answers_to(options, "\xfe\x2c"), "fffc2c") << "DONT COM-PORT later: WONT";
}

}  // namespace
}  // namespace xr3
